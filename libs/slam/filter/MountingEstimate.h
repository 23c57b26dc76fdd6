/// @file MountingEstimate.h
/// @brief How a laser is mounted on the robot, where the log does not say so.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

#include "slam/filter/ScanOdometry.h"

namespace hybrid_slam {

/// Compares the motion of a laser's scans, found by matching alone, with the odometry. Where the robot drives
/// straight on, the angle between them is the yaw of the laser on the robot. Whether the laser is upside down
/// is not estimated: mirrored odometry looks the same.
class MountingEstimate {
 public:
  MountingEstimate(const GridOptions& grid, const ScanMatcherOptions& matcher);

  /// Call it for each reading, until it is done.
  /// @param odometry   since the previous scans (m, rad)
  /// @param scans      as if the laser looked ahead
  /// @param timestamp  s
  void add(const mrpt::math::TPose2D& odometry, const Scans& scans, double timestamp);
  /// Returns whether further readings would hardly matter: the yaw is clear, or 500 scans have been matched.
  bool isDone() const;
  /// Returns the yaw (rad) if at least 9 of 10 straight steps agree on it within 10 deg, and at least 20.
  std::optional<double> yaw() const;

 private:
  void endStep();

  ScanOdometry scanOdometry_;
  size_t matched_ = 0;                   ///< scans
  mrpt::math::TPose2D unmatched_;        ///< odometry since the last scan matched
  mrpt::math::TPose2D odometry_, seen_;  ///< motion in the current step
  std::vector<double> yaws_;             ///< rad, of each straight step
};

}  // namespace hybrid_slam
