/// @file Oddity.h
/// @brief Counts an anomaly of a log.
#pragma once

#include <cstddef>

namespace hybrid_slam::readings {

/// Number of occurrences of an anomaly in a log, and the first line, message or entry (from 1).
struct Oddity {
  size_t count = 0, first = 0;
  /// Says where the occurrences since the last call are.
  void isAt(size_t entry) {
    if (count > 0 && first == 0) first = entry;
  }
};

}  // namespace hybrid_slam::readings
