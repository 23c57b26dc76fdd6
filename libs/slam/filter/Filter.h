/// @file Filter.h
/// @brief Interface of a particle filter for programs: odometry and scans in, map and poses out.
#pragma once

#include "base/LaserScan.h"
#include "slam/filter/FilterView.h"

namespace hybrid_slam {

/// A particle filter that is fed with readings.
class Filter : public FilterView {
 public:
  /// Processes one reading: accumulates the odometry and, if the robot has moved or turned far enough,
  /// updates the filter.
  /// @param odometry  motion since the previous reading (m, rad), in the robot frame at that reading
  /// @param scans     scans after this motion; if empty, the odometry is only accumulated
  /// @throws InputError for a laser that is not mounted horizontally
  virtual void process(const mrpt::math::TPose2D& odometry, const Scans& scans) = 0;
};

}  // namespace hybrid_slam
