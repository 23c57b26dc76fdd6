#include "slam/merging/JoinedPath.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/loops/PathUncertainty.h"
#include "slam/loops/PoseGraph.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kNodeDistance = 1, kNodeAngle = M_PI / 6;  // m, rad: between nodes of a path
constexpr double kReturn = 1.5, kReturnPath = 10;           // m: a path is back at a place
constexpr double kReach = 4;                                // m, of a patch to a node that has seen it
constexpr double kSigma = 0.05, kSigmaAngle = M_PI / 360;   // m, rad: of a place seen twice by one path

double distanceOf(const TPose2D& a, const TPose2D& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The nodes of a path in the graph.
struct Nodes {
  size_t first;               ///< in the graph
  std::vector<size_t> poses;  ///< of the path

  size_t size() const { return poses.size(); }
};

/// Appends the nodes of a path, its motions and its returns.
Nodes append(PoseGraph& graph, const std::vector<TPose2D>& path) {
  Nodes nodes{graph.poses.size(), {}};
  std::vector<double> distances;
  StepVariance variance;
  double distance = 0;
  for (size_t i = 0; i < path.size(); ++i) {
    if (i > 0) {
      const TPose2D step = path[i] - path[i - 1];
      const StepVariance more = stepVariance(step, false);
      variance.position += more.position, variance.heading += more.heading;
      distance += step.norm();
      const TPose2D motion = path[i] - path[nodes.poses.back()];
      if (motion.norm() < kNodeDistance && std::abs(motion.phi) < kNodeAngle) continue;
      const Eigen::Vector3d inverse(1 / variance.position, 1 / variance.position, 1 / variance.heading);
      graph.motions.push_back({graph.poses.size() - 1, graph.poses.size(), motion, inverse.asDiagonal()});
    }
    nodes.poses.push_back(i);
    distances.push_back(distance);
    graph.poses.push_back(path[i]);
    variance = StepVariance();
  }
  const Eigen::Vector3d deviations(kSigma, kSigma, kSigmaAngle);
  const Eigen::Matrix3d information = deviations.cwiseAbs2().cwiseInverse().asDiagonal();
  for (size_t to = 0; to < nodes.size(); ++to)
    for (size_t from = 0; from < to && distances[to] - distances[from] > kReturnPath; ++from) {
      const TPose2D &a = path[nodes.poses[from]], &b = path[nodes.poses[to]];
      if (distanceOf(a, b) < kReturn)
        graph.motions.push_back({nodes.first + from, nodes.first + to, b - a, information});
    }
  return nodes;
}

/// The node next to a place, if there is one in its reach.
std::optional<size_t> nearest(const PoseGraph& graph, const Nodes& nodes, const TPose2D& place) {
  std::optional<size_t> best;
  double least = kReach;
  for (size_t node = nodes.first; node < nodes.first + nodes.size(); ++node)
    if (const double distance = distanceOf(graph.poses[node], place); distance < least)
      least = distance, best = node;
  return best;
}

/// The information on a pose with map axes, in the axes of the node from which the pose is seen.
Eigen::Matrix3d inAxesOf(const TPose2D& node, const Eigen::Matrix3d& information) {
  Eigen::Matrix3d toMap = Eigen::Matrix3d::Identity();
  toMap.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(node.phi).toRotationMatrix();
  return toMap.transpose() * information * toMap;
}

/// Moves a path with its nodes; the error between two is spread over the poses between them.
void follow(std::vector<TPose2D>& path, const Nodes& nodes, const std::vector<TPose2D>& solved) {
  const std::vector<TPose2D> before = path;
  for (size_t k = 0; k < nodes.size(); ++k) {
    const size_t from = nodes.poses[k], to = k + 1 < nodes.size() ? nodes.poses[k + 1] : path.size();
    const auto carried = [&](size_t i) { return solved[nodes.first + k] + (before[i] - before[from]); };
    TPose2D error;
    if (to < path.size()) {
      const TPose2D end = carried(to), &next = solved[nodes.first + k + 1];
      error = {next.x - end.x, next.y - end.y, mrpt::math::wrapToPi(next.phi - end.phi)};
    }
    for (size_t i = from; i < to; ++i) {
      const double share = static_cast<double>(i - from) / static_cast<double>(to - from);
      path[i] = carried(i);
      path[i].x += share * error.x, path[i].y += share * error.y;
      path[i].phi = mrpt::math::wrapToPi(path[i].phi + share * error.phi);
    }
  }
}

}  // namespace

void joinPaths(std::vector<TPose2D>& older, std::vector<TPose2D>& newer, const TPose2D& frame,
               const std::vector<PatchMatch>& patches) {
  PoseGraph graph;
  const Nodes first = append(graph, older), second = append(graph, newer);
  for (const PatchMatch& patch : patches) {
    const TPose2D rigid = frame + patch.newer;  // where a rigid motion puts it
    const auto from = nearest(graph, first, patch.older), to = nearest(graph, second, rigid);
    if (!from || !to) continue;
    const TPose2D seen = patch.older + (graph.poses[*to] - rigid);
    graph.loops.push_back(
        {*from, *to, seen - graph.poses[*from], inAxesOf(graph.poses[*from], patch.information)});
  }
  if (graph.loops.empty()) return;
  const std::vector<TPose2D> solved = optimized(graph).poses;
  follow(older, first, solved);
  follow(newer, second, solved);
}

}  // namespace hybrid_slam
