/// @file SpreadTable.h
/// @brief How the particles' spread goes over time: one run's steps.csv, and many runs together.
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

struct SpreadStep {
  double timestamp = 0;  ///< s
  Spread spread{};
};

/// The updates in a steps.csv, but for the first, which only begins the map: there is no spread yet.
/// @throws std::runtime_error for a file that lacks a column or holds what is not a number
std::vector<SpreadStep> loadSpread(const std::string& file);

/// Mean over the updates; zeros for none.
Spread meanSpread(const std::vector<SpreadStep>& steps);

/// Quartiles over runs at equally spaced times.
struct SpreadBands {
  std::vector<double> times;  ///< s, from the first update of all
  std::array<std::vector<Quartiles>, kSpreads> bands;
};

/// At each time a run counts with its last update before; before its first, not at all.
SpreadBands spreadBands(const std::vector<std::vector<SpreadStep>>& runs, size_t times);

}  // namespace hybrid_slam::comparison
