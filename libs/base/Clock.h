/// @file Clock.h
/// @brief Elapsed time, for time limits and measurements.
#pragma once

#include <chrono>

namespace hybrid_slam {

/// Seconds since `start`, by the monotonic clock.
inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace hybrid_slam
