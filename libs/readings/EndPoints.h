/// @file EndPoints.h
/// @brief The end points of a scan's beams.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <vector>

namespace hybrid_slam::readings {

/// End points of the valid beams of one scan, by angle.
struct EndPoints {
  double timestamp = 0;                      ///< s
  std::vector<mrpt::math::TPoint2D> points;  ///< in the robot frame, m
};

}  // namespace hybrid_slam::readings
