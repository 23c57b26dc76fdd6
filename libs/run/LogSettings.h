/// @file LogSettings.h
/// @brief Settings that depend on the sensor, derived from a log.
#pragma once

#include <string>
#include <vector>

#include "readings/RawlogSource.h"
#include "run/Configuration.h"

namespace hybrid_slam::run {

/// A setting that is derived from the log, and why.
struct LogSetting {
  std::string section, key, value;
  std::string reason;  ///< the evidence in the log
};

/// Properties of the first 2,000 readings of a log, or more if the robot has driven less than 30 m or turned
/// less than 360 deg by then. Ranges are as measured.
struct LogSettings {
  bool hasOdometry = false;
  /// One line for each laser that is used: beams, spacing, place on the robot; or that it has no scan in the
  /// first readings.
  std::vector<std::string> lasers;
  std::vector<LogSetting> settings;
};

/// Derives these settings from a log:
///
/// - `grid.max_range`: 20 m, or more if over 5 % of the returns are farther; never beyond the laser's own
///   limit or the value that it logs for no return. Walls in buildings are near, and far returns are widely
///   spaced.
/// - `grid.resolution`: 0.1 m where the returns of neighbouring beams are over 0.1 m apart, as outdoors or
///   with few beams: in smaller cells, scans would seldom hit the same cell of a wall. Not with an earlier
///   map, which has its own.
/// - `line_weight.sigma_deg`: 0.5 where ranges are logged in steps of 1 cm, else 0.4.
/// - `improved_proposal.update_distance`, `update_angle_deg`: every scan of a moving robot if scans are
///   sparse and overlap little; else 0.1 m and 5 deg.
/// - `input.require_odometry`: false where odometry is missing or never changes.
/// - `input.min_range`: 5 cm above the ranges at the robot's own parts, where beams end at them (RobotParts).
/// - `input.laser_pose`: the heading of the only laser, where the log gives it no place on the robot and the
///   scans move in another direction than the odometry (MountingEstimate).
/// - `input.odometry_time_offset`: where the odometry turns at least 0.25 s after the scans, or before them
///   (OdometryTimeOffset).
///
/// @param log  summary of the file
LogSettings readLogSettings(const std::string& file, const readings::InputOptions& input,
                            const readings::RawlogSummary& log);

/// Applies the settings that neither the INI file nor the command line sets.
/// @return one line for each laser and each applied setting
/// @throws InputError if odometry is required explicitly and the log has none
std::vector<std::string> applyLogSettings(const LogSettings& log, Configuration& configuration);

}  // namespace hybrid_slam::run
