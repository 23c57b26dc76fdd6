/// @file TextLog.h
/// @brief Reads a robot's text log as the objects of a rawlog, one at a time.
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/LineReader.h"
#include "readings/LogFormats.h"
#include "readings/LogObjects.h"

namespace hybrid_slam::readings {

/// How to convert a log.
struct LogConversionOptions : LogParserOptions {
  const LogFormat* format = nullptr;  ///< null: detected from the content
  /// Readings at or beyond this (m) are no returns. Default: 80 m, because a SICK laser in 80 m mode reports
  /// no return as 81.83 or 81.91 m; for DP-SLAM 8.18 m, because its laser ran in 8 m mode (8.183 to 8.191 m);
  /// for tinySLAM 5.6 m; for bags and rawlogs that of each scan.
  std::optional<double> maxRange;
  SweepSetting sweep;              ///< scan times in place of those that the log states
  bool actionObservation = false;  ///< (action, sensory frame) pairs instead of one observation per row
  bool strict = false;             ///< fail at the first broken line or message
  std::function<bool()> isStopped = [] { return false; };  ///< asked after each object
};

/// Called for each broken line with its number and error.
using BrokenLineReport = std::function<void(size_t number, const std::string& why)>;

/// Reads a log, plain or compressed, as a stream in row order, even if timestamps step back. Odometry is
/// labelled `ODOMETRY`, a scan by its record's name. If a scan's row has the robot's odometry pose, that pose
/// precedes the scan at the scan's time, unless the previous odometry entry is identical.
class TextLog {
 public:
  /// @throws InputError for a file that is missing, unreadable, or not a log
  TextLog(const std::string& file, const LogConversionOptions& options, BrokenLineReport report);

  /// Returns the next object; null at the end.
  /// @throws InputError for a truncated or damaged file, a broken line if `strict`, and at the end of a log
  ///         without scans
  mrpt::serialization::CSerializable::Ptr next();

  size_t line() const { return lines_.number(); }                  ///< number of the last line read, from 1
  const LogSummary& summary() const { return objects_->summary; }  ///< of what has been read
  /// Returns the lasers skipped in what has been read, as LogParser.
  std::vector<std::string> ignoredLasers() const { return parser_->ignoredLasers(); }

 private:
  void convert(const std::string& line);

  files::LineReader lines_;
  bool strict_;
  BrokenLineReport report_;
  std::string firstBroken_;  ///< its number and the reason
  std::unique_ptr<LogParser> parser_;
  std::unique_ptr<LogObjects> objects_;
};

}  // namespace hybrid_slam::readings
