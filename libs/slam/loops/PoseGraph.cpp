#include "slam/loops/PoseGraph.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "base/PoseOffset.h"
#include "base/PoseRotation.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kFalseResidual = 25;  // chi^2 above which a loop is false
constexpr int kMostIterations = 50;
constexpr double kNegligibleStep = 1e-7;  // m, rad

TPose2D frameOf(const PoseEdge& edge, const std::vector<TPose2D>& poses) {
  return edge.from == PoseEdge::kMapFrame ? TPose2D() : poses[edge.from];
}

Eigen::Vector3d residual(const PoseEdge& edge, const std::vector<TPose2D>& poses) {
  return offsetOf(poses[edge.to] - frameOf(edge, poses), edge.relative);
}

}  // namespace

double chi2Of(const PoseEdge& edge, const std::vector<TPose2D>& poses) {
  const Eigen::Vector3d off = residual(edge, poses);
  return off.dot(edge.information * off);
}

namespace {

using Edges = std::vector<const PoseEdge*>;

double chi2Of(const Edges& edges, const std::vector<TPose2D>& poses) {
  double sum = 0;
  for (const PoseEdge* edge : edges) sum += chi2Of(*edge, poses);
  return sum;
}

/// The normal equations of the residuals, linear in the map-frame changes of the poses. Without an edge from
/// the map, the first pose stays.
struct NormalEquations {
  size_t fixed;  ///< poses that stay: 0 or 1
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd vector;

  NormalEquations(const Edges& edges, const std::vector<TPose2D>& poses)
      : fixed(std::any_of(edges.begin(), edges.end(), isInMap) ? 0 : 1),
        matrix(row(poses.size()), row(poses.size())),
        vector(Eigen::VectorXd::Zero(row(poses.size()))) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const PoseEdge* edge : edges) {
      const TPose2D from = frameOf(*edge, poses);
      const TPose2D is = poses[edge->to] - from;
      const Eigen::Matrix3d byTo = poseRotation(-from.phi);
      Eigen::Matrix3d byFrom = -byTo;
      byFrom(0, 2) = is.y, byFrom(1, 2) = -is.x;
      const Eigen::Vector3d off = residual(*edge, poses);
      const std::pair<size_t, const Eigen::Matrix3d*> ends[] = {{edge->from, &byFrom}, {edge->to, &byTo}};
      for (const auto& [a, byA] : ends) {
        if (!isFree(a)) continue;
        vector.segment<3>(row(a)) -= byA->transpose() * edge->information * off;
        for (const auto& [b, byB] : ends) {
          if (!isFree(b)) continue;
          const Eigen::Matrix3d block = byA->transpose() * edge->information * *byB;
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) entries.emplace_back(row(a) + i, row(b) + j, block(i, j));
        }
      }
    }
    matrix.setFromTriplets(entries.begin(), entries.end());
  }
  Eigen::Index row(size_t pose) const { return 3 * static_cast<Eigen::Index>(pose - fixed); }

  std::vector<TPose2D> moved(std::vector<TPose2D> poses, const Eigen::VectorXd& step) const {
    for (size_t i = fixed; i < poses.size(); ++i) {
      const auto by = step.segment<3>(row(i));
      poses[i] = {poses[i].x + by[0], poses[i].y + by[1], mrpt::math::wrapToPi(poses[i].phi + by[2])};
    }
    return poses;
  }

 private:
  static bool isInMap(const PoseEdge* edge) { return edge->from == PoseEdge::kMapFrame; }
  bool isFree(size_t pose) const { return pose >= fixed && pose != PoseEdge::kMapFrame; }
};

/// Gauss-Newton; a step that does not lower chi^2 is halved.
std::vector<TPose2D> solve(const Edges& edges, std::vector<TPose2D> poses) {
  double chi2 = chi2Of(edges, poses);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const NormalEquations equations(edges, poses);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(equations.matrix);
    if (factors.info() != Eigen::Success) break;
    Eigen::VectorXd step = factors.solve(equations.vector);
    std::vector<TPose2D> next = equations.moved(poses, step);
    while (!(chi2Of(edges, next) <= chi2) && step.cwiseAbs().maxCoeff() > kNegligibleStep)
      next = equations.moved(poses, step *= 0.5);
    const double reached = chi2Of(edges, next);
    if (!(reached <= chi2)) break;
    poses = std::move(next), chi2 = reached;
    if (step.cwiseAbs().maxCoeff() < kNegligibleStep) break;
  }
  return poses;
}

}  // namespace

OptimizedGraph optimized(const PoseGraph& graph) {
  OptimizedGraph result{graph.poses, std::vector<bool>(graph.loops.size(), false)};
  if (graph.poses.size() < 2) return result;
  for (int solution = 0; solution < 2; ++solution) {
    Edges edges;
    for (const PoseEdge& edge : graph.motions) edges.push_back(&edge);
    for (size_t i = 0; i < graph.loops.size(); ++i)
      if (!result.isFalse[i]) edges.push_back(&graph.loops[i]);
    result.poses = solve(edges, graph.poses);
    size_t worst = graph.loops.size();
    double highest = kFalseResidual;
    for (size_t i = 0; i < graph.loops.size(); ++i) {
      const double chi2 = chi2Of(graph.loops[i], result.poses);
      if (!result.isFalse[i] && chi2 > highest) highest = chi2, worst = i;
    }
    if (worst == graph.loops.size()) break;
    result.isFalse[worst] = true;
  }
  return result;
}

}  // namespace hybrid_slam
