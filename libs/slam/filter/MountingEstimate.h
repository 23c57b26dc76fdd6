/// @file MountingEstimate.h
/// @brief How a laser is mounted on the robot, where the log does not say so.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

#include "slam/filter/ScanOdometry.h"

namespace hybrid_slam {

/// The orientation of a laser on the robot.
struct Mounting {
  double yaw = 0;  ///< rad
  bool isUpsideDown = false;
};

/// Compares the motion of a laser's scans, found by matching alone, with the odometry. Where the robot drives
/// straight on, the angle between them is the yaw of the laser; a laser that is upside down turns the other
/// way. The laser's position on the robot is not estimated.
class MountingEstimate {
 public:
  MountingEstimate(const GridOptions& grid, const ScanMatcherOptions& matcher);

  /// Call it for each reading, until it is done.
  /// @param odometry   since the previous scans (m, rad)
  /// @param scans      of a laser whose pose on the robot is given as zero
  /// @param timestamp  s
  void add(const mrpt::math::TPose2D& odometry, const Scans& scans, double timestamp);
  /// Returns whether further readings would hardly matter: 500 scans have been matched, or the mounting is
  /// clear.
  bool isDone() const;
  /// Returns the mounting if at least 9 of 10 steps agree on it within 10 deg, and on the direction of turns.
  std::optional<Mounting> mounting() const;

 private:
  void endStep();
  /// Returns the direction that most straight steps agree on (rad); empty if they do not.
  std::optional<double> direction() const;

  ScanOdometry scanOdometry_;
  size_t matched_ = 0;                   ///< scans
  mrpt::math::TPose2D unmatched_;        ///< odometry since the last scan matched
  mrpt::math::TPose2D odometry_, seen_;  ///< motion in the current step
  size_t turns_ = 0, against_ = 0;       ///< steps that turn
  struct Straight {
    double expected, seen;  ///< rad, direction of motion by odometry and by the scans
  };
  std::vector<Straight> straight_;  ///< steps
};

}  // namespace hybrid_slam
