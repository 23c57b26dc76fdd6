/// @file LogParser.h
/// @brief The records of text logs, and the base of all parsers.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TPose3D.h>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "readings/BeamAngles.h"

namespace hybrid_slam::readings {

class LogFields;

/// The two timestamps of a CARMEN row.
enum class LogTime {
  ipc,    ///< of the message, set when the sensor was read
  logger  ///< of arrival at the logger, seconds since its start
};

/// The latest time of a record, s. MRPT's timestamps, 64-bit counts of 100 ns since 1601, end at 9e11 s.
constexpr double kLatestTime = 1e11;

/// Pose from wheel odometry, in the odometry frame.
struct OdometryRecord {
  double time = 0;  ///< s
  mrpt::math::TPose2D pose;
};

/// A scan as it is logged.
struct LaserRecord {
  std::string label;          ///< the record's name in the log
  double time = 0;            ///< s
  std::vector<float> ranges;  ///< m, as logged, including NaN, negative readings and codes for no return
  BeamAngles angles;
  mrpt::math::TPose2D laserPose;                ///< in the robot frame
  std::optional<mrpt::math::TPose3D> mounting;  ///< instead of laserPose, where its height and tilt are known
  double sweep = 0;                             ///< s, from the first beam to the last; 0: not known
  double minRange = 0;                          ///< m; nearer readings are no returns
  std::optional<double> maxRange;               ///< m, if in the row
  std::optional<mrpt::math::TPose2D> odometry;  ///< the robot at the scan's time, if in the row
};

/// A valid but unused record, such as `SYNC`.
struct OtherRecord {
  std::string name;
};

/// `monostate`: no record (blank line, comment, parameter).
using LogRecord = std::variant<std::monostate, OtherRecord, OdometryRecord, LaserRecord>;

/// What the rows of a log leave open.
struct LogParserOptions {
  LogTime time = LogTime::ipc;
  double period = 1;                  ///< s between two scans of a DP-SLAM log
  std::optional<double> laserX;       ///< m; front laser ahead of the robot's centre, overrides `PARAM`
  std::optional<double> angularStep;  ///< rad, for scans whose row does not state it
};

/// Parses the lines of one log. Parameters set by a line hold for those after it. Each format derives its own
/// parser (LogFormats.h).
class LogParser {
 public:
  explicit LogParser(const LogParserOptions& options) : options_(options) {}
  virtual ~LogParser() = default;

  /// Parses a line. Blank lines and comments (`#`) are no records.
  /// @throws BrokenLine for a wrong number of fields, a field that is not a number, no ranges, or a number of
  ///         beams with unknown angles
  LogRecord parse(std::string_view line);
  /// Called for the first lines of a log (kPreviewLines), before they are parsed.
  virtual void preview(std::string_view /*line*/) {}
  static constexpr size_t kPreviewLines = 10'000;
  /// Returns a line for each laser of which no row has been used: its name in the log and the reason.
  virtual std::vector<std::string> ignoredLasers() const { return {}; }

 protected:
  /// @param fields  fields after the record's name
  virtual LogRecord record(std::string_view name, LogFields& fields) = 0;
  /// Returns an unused record. @throws BrokenLine if that is not a record's name
  static LogRecord otherRecord(std::string_view name);
  static std::vector<float> ranges(size_t beams, LogFields& fields);
  /// Reads a scan whose row has ranges only; the angles follow from their number or the options.
  LaserRecord scan(std::string_view name, size_t beams, LogFields& fields) const;

  LogParserOptions options_;
};

}  // namespace hybrid_slam::readings
