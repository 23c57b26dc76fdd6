/// @file Clock.h
/// @brief Time that has passed, for time limits and measurements.
#pragma once

#include <chrono>

namespace hybrid_slam {

/// s; nobody sets this clock.
inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace hybrid_slam
