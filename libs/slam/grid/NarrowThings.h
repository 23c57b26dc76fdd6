/// @file NarrowThings.h
/// @brief Beams that may end at a person or another thing that moves.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"
#include "slam/grid/ScanBeams.h"

namespace hybrid_slam {

/// Returns for each beam whether it ends at a thing narrower than 0.5 m that stands in front of what is
/// beside it, on one side at least, such as a person or a chair. Successive beams of a laser end at one thing
/// if their end points are less than 0.3 m apart, or twice the usual distance of two beams there.
std::vector<bool> endsAtNarrowThing(const ScanBeams& beams);

/// Returns for each beam whether it ends at a narrow thing where the map is free within 0.1 m: a person, or a
/// thing that has moved. Such beams fit the map nowhere, and BeamSelection would take many of them, since
/// they end on surfaces of all directions.
/// @param robot  where the scan was taken, map frame; if it is wrong, pillars seem to have moved, too
std::vector<bool> endsAtMovedThing(const ScanBeams& beams, const mrpt::math::TPose2D& robot,
                                   const OccupancyGrid& grid);

/// Returns the scans without some of their valid beams.
/// @param beams  for each valid beam whether to leave it out
LaserScans without(LaserScans scans, const std::vector<bool>& beams);

}  // namespace hybrid_slam
