#include "slam/loops/PoseGraph.h"

#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/levmarq.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose2D.h>

#include <cmath>
#include <set>

namespace hybrid_slam {

using mrpt::graphs::TNodeID;
using mrpt::math::TPose2D;
using Network = mrpt::graphs::CNetworkOfPoses2DInf;

namespace {

constexpr double kFalseResidual = 25;  // chi^2 above which a loop is false

Network::constraint_t constraint(const TPose2D& relative, const Eigen::Matrix3d& information) {
  return {mrpt::poses::CPose2D(relative), mrpt::math::CMatrixDouble33(information)};
}

double residual(const PoseEdge& edge, const std::vector<TPose2D>& poses) {
  const TPose2D is = poses[edge.to] - poses[edge.from];
  const Eigen::Vector3d off(is.x - edge.relative.x, is.y - edge.relative.y,
                            mrpt::math::wrapToPi(is.phi - edge.relative.phi));
  return off.dot(edge.information * off);
}

std::vector<TPose2D> solve(const PoseGraph& graph, const std::vector<double>& loopWeights) {
  Network network;
  std::set<TNodeID> free;
  for (size_t i = 0; i < graph.poses.size(); ++i) {
    network.nodes[i] = mrpt::poses::CPose2D(graph.poses[i]);
    if (i > 0) free.insert(i);
  }
  network.root = 0;
  const auto insert = [&](const PoseEdge& edge) {
    network.insertEdge(edge.from, edge.to, constraint(edge.relative, edge.information));
  };
  for (const PoseEdge& edge : graph.motions) insert(edge);
  // Do not use zero information: MRPT 2.5.8 accepts a step by its residuals without their information.
  for (size_t i = 0; i < graph.loops.size(); ++i)
    if (loopWeights[i] > 0) insert(graph.loops[i]);
  mrpt::graphslam::TResultInfoSpaLevMarq info;
  mrpt::containers::yaml parameters = mrpt::containers::yaml::Map();
  parameters["max_iterations"] = 50;
  mrpt::graphslam::optimize_graph_spa_levmarq(network, info, &free, parameters);
  std::vector<TPose2D> poses;
  for (size_t i = 0; i < graph.poses.size(); ++i) poses.push_back(network.nodes[i].asTPose());
  return poses;
}

}  // namespace

OptimizedGraph optimized(const PoseGraph& graph) {
  OptimizedGraph result{graph.poses, std::vector<double>(graph.loops.size(), 1)};
  if (graph.poses.size() < 2) return result;
  for (int solution = 0; solution < 2; ++solution) {
    result.poses = solve(graph, result.loopWeights);
    size_t worst = graph.loops.size();
    double highest = kFalseResidual;
    for (size_t i = 0; i < graph.loops.size(); ++i) {
      const double chi2 = result.loopWeights[i] * residual(graph.loops[i], result.poses);
      if (chi2 > highest) highest = chi2, worst = i;
    }
    if (worst == graph.loops.size()) break;
    result.loopWeights[worst] = 0;
  }
  return result;
}

}  // namespace hybrid_slam
