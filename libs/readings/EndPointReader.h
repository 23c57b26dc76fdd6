/// @file EndPointReader.h
/// @brief Reads the end points of a log's scans, for evaluation.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "readings/EndPoints.h"

namespace hybrid_slam::readings {

/// The scans of one laser, in the order of the log.
/// @param sensorLabel  of the lasers, as [input] sensor_label; empty: all
/// @param maxRange     m; the smaller of this and the log's own limit applies
/// @throws InputError for a log without scans of that laser, and for a truncated log, whose errors would be
///         those of another drive
std::vector<EndPoints> loadEndPoints(const std::string& rawlog, const std::string& sensorLabel = {},
                                     double maxRange = std::numeric_limits<double>::infinity());

}  // namespace hybrid_slam::readings
