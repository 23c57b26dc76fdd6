/// @file RunCounts.h
/// @brief Counts the events of a run, for its warnings and metrics.json.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "slam/filter/Filter.h"

namespace hybrid_slam::run {

/// Events of the updates so far, and the scans with stuck odometry.
struct RunCounts {
  size_t resamplings = 0;
  size_t slips = 0;  ///< updates whose odometry was rejected
  size_t loops = 0;  ///< closed while filtering
  size_t particlesMin = 0, particlesMax = 0;
  double firstSlip = 0;  ///< s
  size_t stuckScans = 0;
  double firstStuck = 0;  ///< s

  void add(double timestamp, const FilterStep& step);
  void addStuckScan(double timestamp) {
    if (stuckScans++ == 0) firstStuck = timestamp;
  }
  /// One line each on rejected and on stuck odometry, if there was any.
  std::vector<std::string> warnings() const;

  /// Without the stuck scans, which are saved with StuckOdometry.
  template <class State>
  void visit(State& state) {
    state(resamplings, slips, loops, particlesMin, particlesMax, firstSlip);
  }
};

}  // namespace hybrid_slam::run
