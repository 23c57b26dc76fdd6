/// @file LogWarnings.h
/// @brief Warnings about a log.
#pragma once

#include <string>
#include <vector>

#include "readings/RawlogSource.h"

namespace hybrid_slam::readings {

/// Returns a line for each anomaly: count, first entry, how it is handled. A defect (RawlogSummary) is not
/// included.
std::vector<std::string> warningsOf(const RawlogSummary& log, const std::string& file);

}  // namespace hybrid_slam::readings
