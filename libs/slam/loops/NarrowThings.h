/// @file NarrowThings.h
/// @brief Beams that may end at a person or another thing that moves.
#pragma once

#include <vector>

#include "slam/grid/ScanBeams.h"

namespace hybrid_slam {

/// Returns for each beam whether it ends at a thing narrower than 0.5 m that stands in front of what is
/// beside it, on one side at least, such as a person or a chair. Successive beams of a laser end at one thing
/// if their end points are less than 0.3 m apart, or twice the usual distance of two beams there.
std::vector<bool> endsAtNarrowThing(const ScanBeams& beams);

}  // namespace hybrid_slam
