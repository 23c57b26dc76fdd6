/// @file LogConversion.h
/// @brief A robot's text log into a rawlog.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "readings/LogParser.h"

namespace hybrid_slam::readings {

struct LogConversionOptions : LogParserOptions {
  std::optional<LogFormat> format;  ///< empty: told from the content
  /// m; a reading at or beyond it is no return. Empty: 80 m, below the 81.83 and 81.91 m with which a SICK
  /// laser in its 80 m mode says that nothing came back; 8.18 m for DP-SLAM, whose laser ran in the 8 m mode
  /// (8.183 to 8.191 m).
  std::optional<double> maxRange;
  bool actionObservation = false;  ///< (action, sensory frame) pairs instead of an observation for each row
  bool strict = false;             ///< a broken line ends the conversion
};

struct LogSummary {
  LogFormat format = LogFormat::carmen;
  size_t scans = 0, odometryReadings = 0, brokenLines = 0;
  std::map<std::string, size_t> otherRecords;  ///< how many of each name were passed over
  double earliest = 0, latest = 0;             ///< s
  double pathLength = 0;                       ///< m, along the odometry in the order of the log
  float longestRange = 0;                      ///< m, among the valid readings
};

/// Called for each broken line with its number and what is wrong with it.
using BrokenLineReport = std::function<void(size_t number, const std::string& why)>;

/// Converts `logPath` (plain or gzipped) into the rawlog `rawlogPath`, in the order of the log's rows also
/// where their times step back. Odometry is labelled `ODOMETRY`, a scan by its record's name. A scan whose
/// row carries the robot's odometry pose is preceded by that pose at the scan's own time, unless the
/// odometry entry before it says exactly this.
///
/// MRPT's scans are symmetric about the sensor's x axis; a fan of beams that is not has its middle's
/// direction in the yaw of the sensor pose (-0.5 deg for 180 beams from -90 to +89 deg).
///
/// @throws InputError for an input that is missing, unreadable, cut off, not a log, or without a scan, for
/// an output that cannot be written, and for a broken line if `strict`; nothing is then left at `rawlogPath`
LogSummary convertLog(const std::string& logPath, const std::string& rawlogPath,
                      const LogConversionOptions& options, const BrokenLineReport& report);

}  // namespace hybrid_slam::readings
