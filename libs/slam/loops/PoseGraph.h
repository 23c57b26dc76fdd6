/// @file PoseGraph.h
/// @brief Optimises the poses of a path by relative poses, robust against false ones.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <vector>

namespace hybrid_slam {

/// A measured pose of node `to` in the frame of node `from`.
struct PoseEdge {
  size_t from = 0, to = 0;
  mrpt::math::TPose2D relative;
  Eigen::Matrix3d information;

  template <class State>
  void visit(State& state) {
    state(from, to, relative, information);
    state.check(information.allFinite() && information.maxCoeff() <= 1e6 &&
                    information.llt().info() == Eigen::Success,
                "an information is impossible");
  }
};

struct PoseGraph {
  std::vector<mrpt::math::TPose2D> poses;  ///< map frame; the first stays
  std::vector<PoseEdge> motions;           ///< trusted
  std::vector<PoseEdge> loops;             ///< may be false
};

struct OptimizedGraph {
  std::vector<mrpt::math::TPose2D> poses;
  std::vector<double> loopWeights;  ///< of each loop edge: 0 if it was dropped as false, else 1
};

/// Solves for least squares by mrpt::graphslam's sparse Levenberg-Marquardt. The loop with the largest
/// residual is dropped until the others agree with each other and with the motions; at most four are dropped.
OptimizedGraph optimized(const PoseGraph& graph);

}  // namespace hybrid_slam
