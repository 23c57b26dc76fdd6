/// @file CycleGrouper.h
/// @brief Observations as they come from sensors into cycles: a scan and the odometry around it.
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

/// Sorts observations by time, thins scans out to the cycles' rate and closes a cycle as soon as odometry at
/// or after its scan has come, so that whoever gets the cycle can interpolate at once. All times are the
/// observations' own: what is given in the same order gives the same cycles.
class CycleGrouper {
 public:
  /// @param rate  cycles/s; each laser gives at most one scan a cycle. 0: every scan is a cycle
  CycleGrouper(double rate, CycleSink sink) : period_(rate > 0 ? 1 / rate : 0), sink_(std::move(sink)) {}

  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// No more come: gives away what waits.
  void finish();

 private:
  struct Entry {
    double time;  ///< s; that of the newest before it where the observation has none
    mrpt::obs::CObservation::Ptr observation;
  };

  bool isDue(const mrpt::obs::CObservation2DRangeScan& scan, double time);
  void insert(double time, const mrpt::obs::CObservation::Ptr& observation);
  void give(size_t count);

  double period_;  ///< s
  CycleSink sink_;
  std::deque<Entry> waiting_;                    ///< in order of time
  std::map<std::string, double> due_;            ///< s; next cycle of each laser
  std::optional<double> newest_, lastOdometry_;  ///< s
};

/// s; an observation waits no longer than this for others, and one that is older than the newest by more than
/// this shows that the clock was set back, or that another log begins.
constexpr double kLongestWait = 1;

}  // namespace hybrid_slam::live
