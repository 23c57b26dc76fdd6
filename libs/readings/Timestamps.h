/// @file Timestamps.h
/// @brief Timestamps of MRPT's observations.
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace hybrid_slam::readings {

/// A longer step (s) between successive readings is reported.
constexpr double kDay = 86400;

/// Returns whether an observation has a time.
inline bool isStamped(const mrpt::obs::CObservation& observation) {
  return observation.timestamp != INVALID_TIMESTAMP;
}

/// Seconds since 1970, UTC.
inline double seconds(const mrpt::Clock::time_point& t) { return mrpt::Clock::toDouble(t); }

/// Returns the time (s) of an observation; empty without one.
inline std::optional<double> timeOf(const mrpt::obs::CObservation& observation) {
  return isStamped(observation) ? std::optional(seconds(observation.timestamp)) : std::nullopt;
}

/// The time that readings cover (s): from the earliest timestamp to the latest. A step of over a day (an
/// impossible timestamp, two logs in one) begins another part; the durations of the parts are added.
class Duration {
 public:
  void add(double t) {
    if (isEmpty_ || std::abs(t - last_) > kDay) {
      before_ = seconds();
      earliest_ = latest_ = t;
      isEmpty_ = false;
    }
    earliest_ = std::min(earliest_, t);
    latest_ = std::max(latest_, t);
    last_ = t;
  }
  double seconds() const { return before_ + latest_ - earliest_; }

 private:
  bool isEmpty_ = true;
  double before_ = 0;  // of the earlier parts
  double earliest_ = 0, latest_ = 0, last_ = 0;
};

}  // namespace hybrid_slam::readings
