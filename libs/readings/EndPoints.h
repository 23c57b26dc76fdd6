/// @file EndPoints.h
/// @brief What a scan shows: where its beams end.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <vector>

namespace hybrid_slam::readings {

/// Where the valid beams of one scan end, in the order of their angles.
struct EndPoints {
  double timestamp = 0;                      ///< s
  std::vector<mrpt::math::TPoint2D> points;  ///< in the robot frame, m
};

}  // namespace hybrid_slam::readings
