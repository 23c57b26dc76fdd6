/// @file MergeRun.h
/// @brief Two files with maps into a folder with one.
#pragma once

#include <string>

namespace hybrid_slam::run {

struct MergeOptions {
  std::string older, newer;  ///< files or folders (MapPartFile.h)
  std::string output;        ///< folder
  bool overwrite = false;    ///< results that are already there
  int threads = 0;           ///< 0: all cores
};

struct MergeOutcome {
  bool isMerged = false;  ///< else no file was written
  std::string summary;    ///< the figures, one line
  std::string note;       ///< one line if the results do not go to the folder asked for
};

/// Writes the merged map as a run writes its map (doc/results.md), in the frame of the older one: the
/// session, the map files, the trajectory of both, and the figures in metrics.json. Where the maps do not
/// overlap, or fit in several places, it writes nothing.
/// @throws InputError for a file that is no map, and for an output that cannot be written
MergeOutcome merge(const MergeOptions& options);

}  // namespace hybrid_slam::run
