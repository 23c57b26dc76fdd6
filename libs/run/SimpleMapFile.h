/// @file SimpleMapFile.h
/// @brief Writes MRPT's CSimpleMap of a run from the log, without keeping scans in memory.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "files/OutputFolder.h"
#include "readings/RawlogSource.h"

namespace hybrid_slam::run {

/// `map.simplemap.gz`: the scans of the updates, reread from the log, at the best particle's poses (map
/// frame, without covariance).
/// @param isUpdate  for each processed reading of the log, whether it caused an update
/// @param path      one pose per update
void saveSimpleMap(const files::OutputFolder& folder, readings::RawlogSource& source,
                   const std::vector<bool>& isUpdate, const std::vector<mrpt::math::TPose2D>& path);

}  // namespace hybrid_slam::run
