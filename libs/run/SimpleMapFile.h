/// @file SimpleMapFile.h
/// @brief Writes MRPT's CSimpleMap of a run from the log, without keeping scans in memory.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <functional>
#include <string>
#include <vector>

#include "files/OutputFolder.h"
#include "run/LogAgain.h"

namespace hybrid_slam::run {

/// Called with each reading, and at an update its pose (map frame), else null.
using ReadingVisitor = std::function<void(const readings::Reading&, const mrpt::math::TPose2D*)>;

/// Writes `map.simplemap.gz`: the scans of the updates, reread from the log, at the best particle's poses
/// (map frame, without covariance).
/// @param isUpdate  for each processed reading of the log, whether it caused an update
/// @param path      one pose per update
/// @param visit     called with each reading, to parse the log only once
/// @throws UnreadableLog if the log ends early or cannot be read; there is no file then
void saveSimpleMap(
    const files::OutputFolder& folder, LogAgain& log, const std::vector<bool>& isUpdate,
    const std::vector<mrpt::math::TPose2D>& path,
    const ReadingVisitor& visit = [](const readings::Reading&, const mrpt::math::TPose2D*) {});

}  // namespace hybrid_slam::run
