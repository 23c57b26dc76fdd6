/// @file MapPartFile.h
/// @brief Reads maps to be merged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/Configuration.h"
#include "slam/merging/MapMerging.h"

namespace hybrid_slam::run {

/// A map to be merged, with the contents of its file.
struct MapPartFile {
  MapPart part;
  std::vector<double> times;                   ///< s, of each pose of the path; empty: unknown
  std::optional<Configuration> configuration;  ///< of the run
};

/// Reads a session, a map of another program (readKnownMap), or a result folder with a session. The scans of
/// a session are known if they make up its whole map: the run could close loops and did not continue an
/// earlier map.
/// @throws InputError for any other file
MapPartFile readMapPart(const std::string& file);

}  // namespace hybrid_slam::run
