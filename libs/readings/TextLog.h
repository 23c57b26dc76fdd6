/// @file TextLog.h
/// @brief A robot's text log as the objects of a rawlog, one at a time.
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "files/LineReader.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {

struct LogConversionOptions : LogParserOptions {
  const LogFormat* format = nullptr;  ///< null: detected from the content
  /// m; readings at or beyond this are no returns. Empty: 80 m, since a SICK laser in 80 m mode reports no
  /// return as 81.83 or 81.91 m; 8.18 m for DP-SLAM, whose laser ran in 8 m mode (8.183 to 8.191 m).
  std::optional<double> maxRange;
  bool actionObservation = false;  ///< (action, sensory frame) pairs instead of one observation per row
  bool strict = false;             ///< stop at the first broken line
};

struct LogSummary {
  const LogFormat* format = nullptr;
  size_t scans = 0, odometryReadings = 0, brokenLines = 0;
  std::map<std::string, size_t> otherRecords;  ///< number of skipped records by name
  double earliest = 0, latest = 0;             ///< s
  double pathLength = 0;                       ///< m, along the odometry in log order, without jumps
  float longestRange = 0;                      ///< m, among the valid readings
  /// Odometry readings over kMaxStep apart, rows over a day apart: how many, and the line of the first.
  size_t odometryJumps = 0, firstOdometryJump = 0, timeJumps = 0, firstTimeJump = 0;
};

/// Called for each broken line with its number and error.
using BrokenLineReport = std::function<void(size_t number, const std::string& why)>;

/// Reads a log, plain or gzipped, as a stream in row order, even if timestamps step back. Odometry is
/// labelled `ODOMETRY`, a scan by its record's name. If a scan's row has the robot's odometry pose, that pose
/// precedes the scan at the scan's time, unless the previous odometry entry is identical.
///
/// MRPT's scans are symmetric about the sensor's x axis; the offset of an asymmetric fan goes into the yaw of
/// the sensor pose (-0.5 deg for 180 beams from -90 to +89 deg).
class TextLog {
 public:
  /// @throws InputError for a file that is missing, unreadable, or not a log
  TextLog(const std::string& file, const LogConversionOptions& options, BrokenLineReport report);
  ~TextLog();

  /// The next object; null at the end.
  /// @throws InputError for a truncated or damaged file, a broken line if `strict`, and at the end of a log
  ///         without scans
  mrpt::serialization::CSerializable::Ptr next();

  size_t line() const { return lines_.number(); }  ///< number of the last line read, from 1
  const LogSummary& summary() const;               ///< of what has been read

 private:
  class Conversion;
  void convert(const std::string& line);

  files::LineReader lines_;
  bool strict_;
  BrokenLineReport report_;
  std::unique_ptr<LogParser> parser_;
  std::deque<mrpt::serialization::CSerializable::Ptr> ready_;
  std::unique_ptr<Conversion> conversion_;
};

}  // namespace hybrid_slam::readings
