/// @file KnownMap.h
/// @brief The map that a run continues or localises in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/Configuration.h"
#include "slam/filter/MapMaker.h"

namespace hybrid_slam::run {

/// Reads the map of a session, or of another program (MapReader.h), which has no lines.
/// @throws InputError for a file that is neither
ScanMap readKnownMap(const std::string& file);

/// Returns the files that hold a map: the session in a folder of results; a map.yaml and its picture. Empty
/// without a map.
/// @throws InputError for a map.yaml that is not one
std::vector<std::string> filesOfMap(const std::string& map);

/// Reads the map of `continueFrom` or `localizeIn`; empty without one. Sets the cell size of the filter to
/// that of the map. In a map to continue, probabilities are limited to 0.2 to 0.8, so that objects that have
/// moved vanish.
/// @throws InputError for a file that is not a map, if the configuration requires another cell size or
/// method, and for a start from where nothing of the map is in view
std::optional<ScanMap> mapOfEarlierRun(Configuration& configuration);

}  // namespace hybrid_slam::run
