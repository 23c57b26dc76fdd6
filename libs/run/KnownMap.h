/// @file KnownMap.h
/// @brief The map in which a run maps on or localises.
#pragma once

#include <optional>
#include <string>

#include "run/Configuration.h"
#include "slam/filter/Refinement.h"

namespace hybrid_slam::run {

/// The map of a session, or of another program (MapReader.h), which has no lines.
/// @throws InputError for a file that is neither
ScanMap readKnownMap(const std::string& file);

/// That of `continueFrom` or `localizeIn`; empty without one. Sets the cell size of the filter to that of the
/// map. To map on, its probabilities are limited to 0.2 to 0.8, so that what has moved since vanishes.
/// @throws InputError likewise, and for another cell size or method that the configuration requires
std::optional<ScanMap> mapOfEarlierRun(Configuration& configuration);

}  // namespace hybrid_slam::run
