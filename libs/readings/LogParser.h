/// @file LogParser.h
/// @brief Parses the records of CARMEN, GMapping and DP-SLAM logs.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "readings/BeamAngles.h"

namespace hybrid_slam::readings {

class LogFields;

enum class LogFormat {
  carmen,  ///< CARMEN's logger: `ODOM`, `FLASER`, `RLASER`, `ROBOTLASER1`, `PARAM`
  gfs,     ///< GMapping's output: `ODOM`, `LASER_READING`
  dpslam   ///< DP-SLAM: `Odometry`, `Laser`; without times
};

/// Which of the two timestamps of a CARMEN row to use.
enum class LogTime {
  ipc,    ///< of the message, set when the sensor was read
  logger  ///< of arrival at the logger, seconds since its start
};

/// Pose from wheel odometry, in the odometry frame.
struct OdometryRecord {
  double time = 0;  ///< s
  mrpt::math::TPose2D pose;
};

struct LaserRecord {
  std::string label;          ///< the record's name in the log
  double time = 0;            ///< s
  std::vector<float> ranges;  ///< m, as logged: no return, NaN and negative readings included
  BeamAngles angles;
  mrpt::math::TPose2D laserPose;                ///< in the robot frame
  std::optional<double> maxRange;               ///< m, if in the row
  std::optional<mrpt::math::TPose2D> odometry;  ///< the robot at the scan's time, if in the row
};

/// A valid but unused record, such as `SYNC`.
struct OtherRecord {
  std::string name;
};

/// `monostate`: no record (blank line, comment, parameter).
using LogRecord = std::variant<std::monostate, OtherRecord, OdometryRecord, LaserRecord>;

struct LogParserOptions {
  LogTime time = LogTime::ipc;
  double period = 1;                  ///< s between two scans of a DP-SLAM log
  std::optional<double> laserX;       ///< m; front laser ahead of the robot's centre, overrides `PARAM`
  std::optional<double> angularStep;  ///< rad, for scans whose row does not state it
};

/// The log format that a line implies; empty if it could be in any.
std::optional<LogFormat> formatOf(std::string_view line);

/// Parses line by line; parameters and DP-SLAM's clock persist between lines.
class LogParser {
 public:
  LogParser(LogFormat format, const LogParserOptions& options) : format_(format), options_(options) {}

  /// @throws BrokenLine for a wrong number of fields, a field that is not a number, no ranges, or a number of
  ///         beams with unknown angles
  LogRecord parse(std::string_view line);

 private:
  LogRecord carmen(std::string_view name, LogFields& fields);
  LogRecord gfs(std::string_view name, LogFields& fields);
  LogRecord dpslam(std::string_view name, LogFields& fields);
  LogRecord carmenLaser(std::string_view name, LogFields& fields) const;
  LogRecord carmenRobotLaser(std::string_view name, LogFields& fields) const;
  LogRecord gfsOdometry(LogFields& fields);
  void parameter(LogFields& fields);
  double carmenTime(LogFields& fields) const;
  LaserRecord scan(std::string_view name, size_t beams, LogFields& fields) const;

  LogFormat format_;
  LogParserOptions options_;
  double frontOffset_ = 0, rearOffset_ = 0;  // m
  // GMapping
  std::optional<double> lastOdometryTime_, lastScanTime_;
  // DP-SLAM: a step is an odometry row and the scans after it, up to the second scan.
  int step_ = -1;
  bool stepHasScan_ = true;
};

}  // namespace hybrid_slam::readings
