/// @file Timestamps.h
/// @brief Timestamps of MRPT's observations.
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>

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

}  // namespace hybrid_slam::readings
