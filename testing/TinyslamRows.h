/// @file TinyslamRows.h
/// @brief For the tests: rows of tinySLAM's logs, and a drive in the room of TestLogs.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "testing/TestLogs.h"

namespace hybrid_slam::test {

constexpr size_t kTinyslamBeams = 682;

/// @param left, right  positions of the wheels (ticks)
/// @param ranges       mm, of all beams; 0: no return
inline std::string tinyslamRow(int64_t microseconds, int64_t left, int64_t right,
                               const std::vector<int>& ranges) {
  std::string row =
      std::to_string(microseconds) + " 14554 " + std::to_string(left) + " " + std::to_string(right);
  for (int i = 4; i < 24; ++i) row += " 7";  // not read
  for (const int range : ranges) row += " " + std::to_string(range);
  return row + " 0";
}

/// Way (m) of the robot of tinyslamDrive, `time` s after its first row.
inline double tinyslamWay(double time) { return 0.5 * std::max(0.0, time - 1); }

/// A log with a row every 0.2 s: the robot stands for 1 s and then drives towards a wall, along the x axis.
/// Its laser is 0.145 m ahead of its centre and sees 4 m far. The wheels of a row are 0.15 s newer than its
/// scan.
inline std::string tinyslamDrive(size_t rows) {
  constexpr double kTick = 2 * M_PI * 0.077 / 2000;  // m
  std::string log;
  for (size_t i = 0; i < rows; ++i) {
    const double time = 0.2 * static_cast<double>(i);
    std::vector<int> ranges(kTinyslamBeams);
    for (size_t beam = 0; beam < kTinyslamBeams; ++beam) {
      const double angle = (static_cast<double>(beam) - 341) * 2 * M_PI / 1024;
      const double range = rangeInRoom(1.2 + tinyslamWay(time) + 0.145, 0.3, angle);
      ranges[beam] = range < 4 ? static_cast<int>(std::lround(1000 * range)) : 0;
    }
    const int64_t ticks = std::lround(tinyslamWay(time + 0.15) / kTick);
    log += tinyslamRow(std::lround(1e6 * (1 + time)), 5000 + ticks, 3000 + ticks, ranges) + "\n";
  }
  return log;
}

}  // namespace hybrid_slam::test
