/// @file Degree.h
/// @brief One degree.
#pragma once

#include <mrpt/core/bits_math.h>

namespace hybrid_slam {

inline constexpr double kDegree = mrpt::DEG2RAD(1.0);  ///< rad

}  // namespace hybrid_slam
