/// @file Filter.h
/// @brief A particle filter as programs run it: odometry and scans in, map and poses out.
#pragma once

#include "base/LaserScan.h"
#include "slam/filter/FilterView.h"

namespace hybrid_slam {

class Filter : public FilterView {
 public:
  /// One reading: gathers the odometry and, if the robot has moved or turned far enough, updates the filter.
  /// @param odometry  motion since the reading before (m, rad), in the robot frame there
  /// @param scans     what the lasers see after it; without any, the odometry is only gathered
  /// @throws InputError for a laser that is not mounted horizontally
  virtual void process(const mrpt::math::TPose2D& odometry, const Scans& scans) = 0;
};

}  // namespace hybrid_slam
