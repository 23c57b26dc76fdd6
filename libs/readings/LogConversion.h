/// @file LogConversion.h
/// @brief Converts a robot's text log into a rawlog.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

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
  double pathLength = 0;                       ///< m, along the odometry in log order
  float longestRange = 0;                      ///< m, among the valid readings
};

/// Called for each broken line with its number and error.
using BrokenLineReport = std::function<void(size_t number, const std::string& why)>;

/// Converts `logPath` (plain or gzipped) into the rawlog `rawlogPath`, in row order, even if timestamps step
/// back. Odometry is labelled `ODOMETRY`, a scan by its record's name. If a scan's row has the robot's
/// odometry pose, that pose precedes the scan at the scan's time, unless the previous odometry entry is
/// identical.
///
/// MRPT's scans are symmetric about the sensor's x axis; the offset of an asymmetric fan goes into the yaw of
/// the sensor pose (-0.5 deg for 180 beams from -90 to +89 deg).
///
/// @throws InputError for an input that is missing, unreadable, truncated, not a log, or without scans, for
///         an unwritable output, and for a broken line if `strict`; no file is then left at `rawlogPath`
LogSummary convertLog(const std::string& logPath, const std::string& rawlogPath,
                      const LogConversionOptions& options, const BrokenLineReport& report);

}  // namespace hybrid_slam::readings
