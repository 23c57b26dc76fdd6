/// @file PoseGraph.h
/// @brief Optimises the poses of a path by relative poses, robust against false ones.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <limits>
#include <vector>

namespace hybrid_slam {

/// A measured pose of node `to` in the frame of node `from`, or of the map.
struct PoseEdge {
  static constexpr size_t kMapFrame = std::numeric_limits<size_t>::max();  ///< `from` of a pose in the map
  size_t from = 0, to = 0;
  mrpt::math::TPose2D relative;  ///< m, rad
  Eigen::Matrix3d information;   ///< of x, y, phi in the frame of `from` (1/m^2, 1/(m rad), 1/rad^2)

  template <class State>
  void visit(State& state) {
    state(from, to, relative, information);
    state.check(information.allFinite() && information.maxCoeff() <= 1e6 &&
                    information.llt().info() == Eigen::Success,
                "an information is impossible");
  }
};

/// Squared Mahalanobis distance of the poses from the edge's measurement.
double chi2Of(const PoseEdge& edge, const std::vector<mrpt::math::TPose2D>& poses);

/// Poses and what is known about the motions between them.
struct PoseGraph {
  std::vector<mrpt::math::TPose2D> poses;  ///< map frame; without an edge from it, the first stays
  std::vector<PoseEdge> motions;           ///< trusted
  std::vector<PoseEdge> loops;             ///< may be false
};

/// The most likely poses, and the loops that they agree with.
struct OptimizedGraph {
  std::vector<mrpt::math::TPose2D> poses;
  std::vector<bool> isFalse;  ///< of each loop edge; two false ones: no solution
};

/// Solves for least squares by Gauss-Newton with a sparse Cholesky factorisation. (mrpt::graphslam 2.5.8
/// accepts a step by the sum of the residuals without their information, so it stops early:
/// doc/mrpt-notes.md.) If the loops do not agree with each other and with the motions, the one with the
/// largest residual is dropped. If the others do not agree either, there is no solution.
OptimizedGraph optimized(const PoseGraph& graph);

}  // namespace hybrid_slam
