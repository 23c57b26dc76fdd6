/// @file MergeRun.h
/// @brief Merges two map files into a result folder.
#pragma once

#include <string>

namespace hybrid_slam::run {

/// What to merge, and where to.
struct MergeOptions {
  std::string older, newer;  ///< files or folders (MapPartFile.h)
  std::string output;        ///< folder
  bool overwrite = false;    ///< existing results
  int threads = 0;           ///< 0: all cores
};

/// What has become of a merge.
struct MergeOutcome {
  bool isMerged = false;  ///< false: no file was written
  std::string summary;    ///< the figures, one line
  std::string note;       ///< one line if the results do not go to the requested folder
};

/// Writes the merged map in the frame of the older one, in the files of doc/results.md: session, map files,
/// trajectory of both, and figures in metrics.json. Writes nothing if the maps do not overlap, or fit in
/// several places.
/// @throws InputError for a file that is not a map, and an output that cannot be written
MergeOutcome merge(const MergeOptions& options);

}  // namespace hybrid_slam::run
