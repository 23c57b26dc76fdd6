/// @file MapPartFile.h
/// @brief Maps to be merged, from files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/Configuration.h"
#include "slam/merging/MapMerging.h"

namespace hybrid_slam::run {

/// What a file holds of a map.
struct MapPartFile {
  MapPart part;
  std::vector<double> times;                   ///< s, of each pose of the path; empty: unknown
  std::optional<Configuration> configuration;  ///< of the run
};

/// A session, a map of another program (readKnownMap), or a folder of results with its session. The scans of
/// a session are known if they make up its whole map: the run could close loops and did not continue an
/// earlier map.
/// @throws InputError for a file that is none of them
MapPartFile readMapPart(const std::string& file);

}  // namespace hybrid_slam::run
