/// @file SweepTimes.h
/// @brief Durations of the lasers' sweeps, as stated by logs and settings.
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>

#include <map>
#include <optional>
#include <string>

namespace hybrid_slam::readings {

/// Longest sweep (s): the slowest lasers turn once a second.
constexpr double kLongestSweep = 1;
/// Returns whether a sweep can take this time (s); 0: unknown.
inline bool isSweepTime(double seconds) { return seconds >= 0 && seconds <= kLongestSweep; }

/// Lowest and highest rate (Hz) that can be set.
constexpr double kLowestRate = 1, kHighestRate = 1000;

/// Sweep times that the user sets in place of those of the log: a time or a rate. If both are set, the rate
/// counts.
struct SweepSetting {
  std::optional<double> seconds;  ///< of each scan; 0: beams are not corrected
  std::optional<double> rate;     ///< Hz, turns of the laser per second
  /// Returns the sweep time (s) of a scan over an aperture (rad), 0 if that time is impossible; empty if
  /// nothing is set.
  std::optional<double> of(double aperture) const;
};

constexpr size_t kMostLabels = 100;  ///< of lasers that a log names; no robot has more

/// Sweep time stated by a log. MRPT's scans (2.5.8, 2.14.7) have no field for it, so rawlogs have a comment
/// before the scans of the laser, `scan_time = 0.075 s, laser LASER`, which holds for all later scans with
/// this label.
struct SweepTime {
  std::string label;
  double seconds = 0;  ///< from the first beam to the last; NaN for a text that is not a number
};

/// Returns a comment that states a sweep time, for a log.
mrpt::obs::CObservationComment::Ptr commentOf(const SweepTime& sweep, mrpt::Clock::time_point timestamp);
/// Returns the sweep time that a comment states; empty for other observations.
std::optional<SweepTime> sweepTimeIn(const mrpt::obs::CObservation& observation);

/// Sweep times of a log's scans. The beams are measured one after another at equal intervals, in the order of
/// their indices; a scan's timestamp is the time of the first, as in ROS. MRPT agrees: `sensorPose` is the
/// pose "at the moment of starting the scan".
class SweepTimes {
 public:
  /// Uses the times that the log states.
  SweepTimes() = default;
  explicit SweepTimes(const SweepSetting& setting) : setting_(setting) {}
  /// @param seconds  for all scans, instead of the times in the log; 0: beams are not corrected
  explicit SweepTimes(double seconds) : setting_{seconds, std::nullopt} {}

  /// Takes a time that the log states. Impossible times count as unknown. Only the first 100 labels are kept,
  /// so that memory is bounded.
  void take(const SweepTime& sweep) {
    if (stated_.size() < kMostLabels || stated_.count(sweep.label) > 0)
      stated_[sweep.label] = isSweepTime(sweep.seconds) ? sweep.seconds : 0;
  }
  /// Returns the sweep time (s); 0: unknown, or a scan that cannot be corrected, without timestamp or with a
  /// single beam.
  double of(const mrpt::obs::CObservation2DRangeScan& scan) const;

 private:
  SweepSetting setting_;
  std::map<std::string, double> stated_;  ///< by label
};

}  // namespace hybrid_slam::readings
