/// @file OdometryBridge.h
/// @brief Interpolates a trajectory with odometry.
#pragma once

#include <map>
#include <optional>

#include "files/Trajectory.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::evaluation {

/// A pose between or at the poses of a trajectory.
struct TrajectoryPoint {
  mrpt::math::TPose2D pose{};  ///< m, rad
  size_t row = 0;              ///< of the trajectory: its pose here, or the last one before
};

/// A filter gives poses only at its updates. Between two of them, the pose at an odometry row is the last
/// trajectory pose composed with the odometry since; the closing error at the next trajectory pose is spread
/// equally over the rows in between.
///
/// Order is the odometry's file order, since timestamps may step back.
class OdometryBridge {
 public:
  /// Largest tolerance (s). Dense odometry has a row at each queried time, and the next one is often only
  /// 0.01 s away: a larger tolerance would match the wrong row.
  static constexpr double kWidestTolerance = 0.006;

  /// @param odometry   `t x y theta` rows in log order; must outlive the bridge
  /// @param tolerance  s; largest time difference to an odometry row, at most kWidestTolerance
  OdometryBridge(const files::Trajectory& trajectory, const files::Trajectory& odometry, double tolerance);

  /// Returns the pose at a time (s); empty without an odometry row within the tolerance, and before the first
  /// trajectory pose.
  std::optional<TrajectoryPoint> poseAt(double timestamp) const;

 private:
  const files::Trajectory& odometry_;
  StampIndex rows_;
  double tolerance_;
  std::map<size_t, TrajectoryPoint> anchors_;  ///< trajectory poses by odometry row
};

}  // namespace hybrid_slam::evaluation
