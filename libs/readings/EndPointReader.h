/// @file EndPointReader.h
/// @brief Reads the end points of a log's scans, for evaluation.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "readings/EndPoints.h"
#include "readings/RawlogSource.h"

namespace hybrid_slam::readings {

/// Called with the warnings about a log (warningsOf).
using WarningReport = std::function<void(const std::vector<std::string>&)>;

/// Reads the end points of each scan in the order of the log.
/// @param options   which lasers, where they are on the robot, and the times of their beams
/// @param maxRange  m; the smaller of this and the log's own limit applies
/// @param report    called before the scans are read
/// @param mostKept  limit of the scans and valid beams together; the default takes 2 GB of memory
/// @throws InputError for a log without scans of these lasers or with too many, and for a truncated log,
///         which would give the errors of a shorter drive
std::vector<EndPoints> loadEndPoints(const std::string& rawlog, const InputOptions& options = {},
                                     double maxRange = std::numeric_limits<double>::infinity(),
                                     const WarningReport& report = {}, size_t mostKept = size_t{1} << 27);

}  // namespace hybrid_slam::readings
