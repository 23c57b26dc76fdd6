/// @file OdometryClock.h
/// @brief Transfers odometry to the clock of the scans.
#pragma once

#include <mrpt/obs/CObservation.h>

#include <deque>
#include <limits>
#include <vector>

namespace hybrid_slam::readings {

/// Adds an offset to the timestamps of odometry readings, and holds back the scans or the odometry, so that
/// both come out in order of time, as if there were one clock. It takes the observations in either order:
/// that of their timestamps, or that of arrival.
class OdometryClock {
 public:
  /// @param offset  s
  explicit OdometryClock(double offset) : offset_(offset) {}

  /// Takes a scan or an odometry reading. Returns the observations that continue now.
  std::vector<mrpt::obs::CObservation::Ptr> take(const mrpt::obs::CObservation::Ptr& observation);
  /// End of input: returns those held back.
  std::vector<mrpt::obs::CObservation::Ptr> finish();

 private:
  /// Appends those held back with a time before `time` (s), or at it if `isInclusive`.
  void release(double time, bool isInclusive, std::vector<mrpt::obs::CObservation::Ptr>& released);

  double offset_;
  double now_ = -std::numeric_limits<double>::infinity();  ///< s, the latest timestamp
  std::deque<mrpt::obs::CObservation::Ptr> held_;          ///< of one kind, with times on the scans' clock
  size_t heldBeams_ = 0;
};

}  // namespace hybrid_slam::readings
