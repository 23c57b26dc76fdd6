/// @file SimpleMapFile.h
/// @brief MRPT's CSimpleMap of a run, written from the log without holding its scans in memory.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "files/OutputFolder.h"
#include "readings/RawlogSource.h"

namespace hybrid_slam::run {

/// `map.simplemap.gz`: the scans that made the filter run, read from the log once more, at the best
/// particle's poses (in the map frame, without covariance).
/// @param isUpdate  for each reading of the log that was processed, whether the filter ran with it
/// @param path      one pose for each of those that did
void saveSimpleMap(const files::OutputFolder& folder, readings::RawlogSource& source,
                   const std::vector<bool>& isUpdate, const std::vector<mrpt::math::TPose2D>& path);

}  // namespace hybrid_slam::run
