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

/// The time that readings cover (s): from the earliest timestamp to the latest. With a step of over a day (an
/// impossible timestamp, two logs in one), the sum of the other steps forward.
class Duration {
 public:
  void add(double t) {
    if (isEmpty_) earliest_ = latest_ = last_ = t;
    isEmpty_ = false;
    const double step = t - last_;
    if (std::abs(step) > kDay)
      hasJump_ = true;
    else if (step > 0)
      steps_ += step;
    earliest_ = std::min(earliest_, t);
    latest_ = std::max(latest_, t);
    last_ = t;
  }
  double seconds() const { return hasJump_ ? steps_ : latest_ - earliest_; }

 private:
  bool isEmpty_ = true, hasJump_ = false;
  double earliest_ = 0, latest_ = 0, last_ = 0, steps_ = 0;
};

}  // namespace hybrid_slam::readings
