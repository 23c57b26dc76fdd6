/// @file SweepTimes.h
/// @brief How long lasers take for the beams of a scan, as logs and settings state.
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>

#include <map>
#include <optional>
#include <string>

namespace hybrid_slam::readings {

/// s; the slowest lasers turn once a second.
constexpr double kLongestSweep = 1;
/// Whether a laser can take this time (s); 0: not known.
inline bool isSweepTime(double seconds) { return seconds >= 0 && seconds <= kLongestSweep; }

/// What a log states. MRPT's scans (2.5.8, 2.14.7) have no place for it, so a comment before the scans of the
/// laser does: `scan_time = 0.075 s, laser LASER`. It holds for all scans of this label after it.
struct SweepTime {
  std::string label;
  double seconds = 0;  ///< from the first beam to the last; NaN for a text that is not a number
};

mrpt::obs::CObservationComment::Ptr commentOf(const SweepTime& sweep, mrpt::Clock::time_point timestamp);
/// Empty for other observations.
std::optional<SweepTime> sweepTimeIn(const mrpt::obs::CObservation& observation);

/// The times that hold for the scans of a log. The beams are measured one after another at equal intervals,
/// in the order of their indices; a scan's timestamp is the time of the first, as in ROS. MRPT agrees:
/// `sensorPose` is the pose "at the moment of starting the scan".
class SweepTimes {
 public:
  /// The times that the log states.
  SweepTimes() = default;
  /// @param fixed  s, for all scans, in place of those that the log states; 0: beams are not corrected
  explicit SweepTimes(const std::optional<double>& fixed) : fixed_(fixed) {}

  /// Impossible times count as not known.
  void take(const SweepTime& sweep) { stated_[sweep.label] = isSweepTime(sweep.seconds) ? sweep.seconds : 0; }
  /// s; 0: not known, or a scan whose beams cannot be corrected, without timestamp or with a single beam.
  double of(const mrpt::obs::CObservation2DRangeScan& scan) const;

 private:
  std::optional<double> fixed_;
  std::map<std::string, double> stated_;  ///< by label
};

}  // namespace hybrid_slam::readings
