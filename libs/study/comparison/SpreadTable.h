/// @file SpreadTable.h
/// @brief Particle spread over time, of one run (steps.csv) and over many runs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "study/comparison/Statistics.h"

namespace hybrid_slam::comparison {

/// Spread of the weighted particles along and across the robot's heading (m), of the heading (deg), and along
/// the map's axes x and y (m).
constexpr size_t kSpreads = 5;
using Spread = std::array<double, kSpreads>;

/// The spread at one update.
struct SpreadStep {
  double timestamp = 0;  ///< s
  Spread spread{};
};

/// The updates in a steps.csv except the first, which starts the map and has no spread.
/// @throws std::runtime_error for a file with a missing column or a value that is not a number
std::vector<SpreadStep> loadSpread(const std::string& file);

/// Mean over the updates; zeros if there are none.
Spread meanSpread(const std::vector<SpreadStep>& steps);

/// Quartiles over runs at equally spaced times.
struct SpreadBands {
  std::vector<double> times;  ///< s, from the first update of all
  std::array<std::vector<Quartiles>, kSpreads> bands;
};

/// Computes the bands. At each time, a run contributes its last update so far, if any.
SpreadBands spreadBands(const std::vector<std::vector<SpreadStep>>& runs, size_t times);

}  // namespace hybrid_slam::comparison
