/// @file ResultFiles.h
/// @brief Names of the files of a run.
#pragma once

#include <string>
#include <vector>

#include "run/SessionFile.h"

namespace hybrid_slam::run {

/// All files that a run may write (doc/results.md). metrics.json is last: it marks a complete run.
inline const std::vector<std::string> kResultFiles{
    "trajectory.tum",   "covariance.csv", "map.png",    "map.pgm",       "map.yaml",     "map.gridmap.gz",
    "map.simplemap.gz", "lines.csv",      "plan.svg",   "plan.dxf",      "plan.geojson", "steps.csv",
    "particles.csv",    "config.ini",     kSessionName, kCheckpointName, "metrics.json"};

}  // namespace hybrid_slam::run
