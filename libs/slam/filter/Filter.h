/// @file Filter.h
/// @brief Interface of a particle filter for programs: odometry and scans in, map and poses out.
#pragma once

#include <cmath>

#include "base/Errors.h"
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
  /// @throws InputError for a laser that is not mounted horizontally, and odometry that is not finite
  virtual void process(const mrpt::math::TPose2D& odometry, const Scans& scans) = 0;
};

/// @throws InputError for odometry that is not finite
inline void expectFinite(const mrpt::math::TPose2D& odometry) {
  if (!std::isfinite(odometry.x) || !std::isfinite(odometry.y) || !std::isfinite(odometry.phi))
    throw InputError("odometry is not a number", "a reading", "expected a finite motion");
}

}  // namespace hybrid_slam
