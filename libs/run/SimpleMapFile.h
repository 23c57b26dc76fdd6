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

/// Called with the pose (map frame) and the scans of each update.
using UpdateVisitor = std::function<void(const mrpt::math::TPose2D&, const Scans&)>;

/// Writes `map.simplemap.gz`: the scans of the updates, reread from the log, at the best particle's poses
/// (map frame, without covariance).
/// @param isUpdate  for each processed reading of the log, whether it caused an update
/// @param path      one pose per update
/// @param visit     called with each update's scans, to parse the log only once
/// @throws UnreadableLog if the log ends early or cannot be read; there is no file then
void saveSimpleMap(
    const files::OutputFolder& folder, LogAgain& log, const std::vector<bool>& isUpdate,
    const std::vector<mrpt::math::TPose2D>& path,
    const UpdateVisitor& visit = [](const mrpt::math::TPose2D&, const Scans&) {});

}  // namespace hybrid_slam::run
