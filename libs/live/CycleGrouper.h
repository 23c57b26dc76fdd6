/// @file CycleGrouper.h
/// @brief Groups sensor observations into cycles: a scan and the odometry around it.
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <deque>
#include <map>
#include <optional>
#include <string>

#include "live/CycleSource.h"

namespace hybrid_slam::live {

/// Sorts observations by time, reduces scans to the cycle rate, and closes a cycle once odometry at or after
/// its scan has arrived, so that the receiver can interpolate immediately. Only observation timestamps are
/// used: the same observations in the same order give the same cycles.
class CycleGrouper {
 public:
  /// @param rate  cycles/s; each laser gives at most one scan per cycle. 0: one cycle per scan
  CycleGrouper(double rate, CycleSink sink) : period_(rate > 0 ? 1 / rate : 0), sink_(std::move(sink)) {}

  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// Ends the input: delivers the pending observations.
  void finish();

 private:
  struct Entry {
    double time;  ///< s; the previous newest time if the observation has none
    mrpt::obs::CObservation::Ptr observation;
  };

  bool isDue(const mrpt::obs::CObservation2DRangeScan& scan, double time);
  void insert(double time, const mrpt::obs::CObservation::Ptr& observation);
  void give(size_t count);

  double period_;  ///< s
  CycleSink sink_;
  std::deque<Entry> waiting_;  ///< in order of time
  size_t waitingBeams_ = 0;
  std::map<std::string, double> due_;            ///< s; next cycle of each laser
  std::optional<double> newest_, lastOdometry_;  ///< s
};

/// Longest time (s) that an observation waits for others. An observation older than the newest by more than
/// this means that the clock was set back or another log begins.
constexpr double kLongestWait = 1;
/// Largest number of waiting observations, far more than sensors give in kLongestWait; more mean that
/// timestamps do not advance.
constexpr size_t kMostWaiting = 1000;
/// Largest number of their beams: bounds the memory.
constexpr size_t kMostWaitingBeams = 3'000'000;
/// Largest number of labels of lasers; scans of others are left out.
constexpr size_t kMostLasers = 1000;

}  // namespace hybrid_slam::live
