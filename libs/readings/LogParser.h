/// @file LogParser.h
/// @brief The records of CARMEN, GMapping and DP-SLAM logs, from text to numbers.
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
  gfs,     ///< what GMapping writes while it maps: `ODOM`, `LASER_READING`
  dpslam   ///< DP-SLAM: `Odometry`, `Laser`; without times
};

/// Which of the two times of a CARMEN row is the reading's.
enum class LogTime {
  ipc,    ///< of the message itself, set where the sensor was read
  logger  ///< of its arrival at the logger, in seconds from the logger's start
};

/// The pose that the wheels report, in the odometry frame.
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
  std::optional<double> maxRange;               ///< m, where the row says so
  std::optional<mrpt::math::TPose2D> odometry;  ///< the robot at the scan's time, where the row says so
};

/// A record that is in order and of no use here, such as `SYNC`.
struct OtherRecord {
  std::string name;
};

/// `monostate`: nothing to pass on (blank line, comment, parameter).
using LogRecord = std::variant<std::monostate, OtherRecord, OdometryRecord, LaserRecord>;

struct LogParserOptions {
  LogTime time = LogTime::ipc;
  double period = 1;                  ///< s between two scans of a DP-SLAM log
  std::optional<double> laserX;       ///< m; the front laser ahead of the robot's centre, over `PARAM`
  std::optional<double> angularStep;  ///< rad, for scans whose row does not carry it
};

/// The format that a line gives away; empty for a line that could stand in any log.
std::optional<LogFormat> formatOf(std::string_view line);

/// Reads one line after the other; parameters and DP-SLAM's clock carry over from line to line.
class LogParser {
 public:
  LogParser(LogFormat format, const LogParserOptions& options) : format_(format), options_(options) {}

  /// @throws BrokenLine for a line with a wrong number of fields, with a field that is not a number, with no
  /// ranges, or with a number of beams whose angles are not known
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
