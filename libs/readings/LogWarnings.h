/// @file LogWarnings.h
/// @brief What is wrong with a log, for the user.
#pragma once

#include <string>
#include <vector>

#include "readings/RawlogSource.h"

namespace hybrid_slam::readings {

/// A line for each anomaly: count, first entry, what is done about it. A defect (RawlogSummary) is not among
/// them.
std::vector<std::string> warningsOf(const RawlogSummary& log, const std::string& file);

}  // namespace hybrid_slam::readings
