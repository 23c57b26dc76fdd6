/// @file OdometryBridge.h
/// @brief Where the robot was between two poses of a trajectory, carried there by its odometry.
#pragma once

#include <map>
#include <optional>

#include "files/Trajectory.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::evaluation {

/// A filter that updates every metre says nothing about the moments between. The bridge does: the pose at an
/// odometry row r is the last trajectory pose a at or before it, composed with the odometry's motion from
/// there; what then misses the next trajectory pose b is spread over the rows in between, in equal parts.
///
/// Before and after are meant in the odometry's file order, which is the truth where stamps step back.
class OdometryBridge {
 public:
  /// Dense odometry has a row at each time that is asked for; the next row is often only 0.01 s away, so
  /// that a wider match would be a match with another reading. s.
  static constexpr double kWidestTolerance = 0.006;

  /// @param odometry   `t x y theta` rows in the order the robot logged them; must outlive the bridge
  /// @param tolerance  s; how far a stamp may be from its odometry row, at most kWidestTolerance
  OdometryBridge(const files::Trajectory& trajectory, const files::Trajectory& odometry, double tolerance);

  /// Empty where no odometry row lies within the tolerance, and before the first pose of the trajectory.
  std::optional<mrpt::math::TPose2D> poseAt(double timestamp) const;

 private:
  const files::Trajectory& odometry_;
  StampIndex rows_;
  double tolerance_;
  std::map<size_t, mrpt::math::TPose2D> anchors_;  ///< trajectory poses by odometry row
};

}  // namespace hybrid_slam::evaluation
