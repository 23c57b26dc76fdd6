/// @file WallGaps.h
/// @brief Parts of straight walls between the end points of neighbouring beams.
#pragma once

#include <vector>

#include "slam/grid/ScanBeams.h"

namespace hybrid_slam {

/// Returns each beam, as an index in scan.rays, that hits the same straight wall as the next one, at most
/// `longest` (m) apart. Both end points are within 5 cm of the line between those before and after them, and
/// the laser has no other beam between the two: one without a return may have passed through a door.
std::vector<size_t> wallGaps(const ScanBeams& scan, double longest);

}  // namespace hybrid_slam
