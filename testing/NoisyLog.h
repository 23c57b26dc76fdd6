/// @file NoisyLog.h
/// @brief For the tests: logs of RoomLog.h with noise.
#pragma once

#include "base/RandomStream.h"
#include "testing/RoomLog.h"

namespace hybrid_slam::test {

/// Adds noise of 1 cm to all ranges of the log's scans. The room's walls lie on borders of cells, where scans
/// without noise contradict the map by rounding.
inline void addNoise(const Log& log) {
  RandomStream random(1, 0, 0);
  for (const auto& entry : log)
    if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(entry))
      for (size_t i = 0; i < scan->getScanSize(); ++i)
        scan->setScanRange(i, scan->getScanRange(i) + static_cast<float>(0.01 * random.gaussian()));
}

}  // namespace hybrid_slam::test
