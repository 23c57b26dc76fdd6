/// @file Happens.h
/// @brief For the tests: waiting for what other threads and programs do.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace hybrid_slam::test {

/// Waits for a condition; a minute is for machines that are busy, not for what is being waited for.
inline bool happens(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace hybrid_slam::test
