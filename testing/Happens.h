/// @file Happens.h
/// @brief For the tests: waits for other threads and programs.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace hybrid_slam::test {

/// Waits up to a minute for a condition; the margin is for busy machines.
inline bool happens(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace hybrid_slam::test
