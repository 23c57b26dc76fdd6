/// @file GlobalSearch.h
/// @brief Where in the whole map a scan may have been taken.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Share of the beams that contradict the map at a pose: they end where it is free, or pass through a wall.
/// Beams through unknown cells contradict nothing. In [0, 1]; 0 without beams.
double contradictedShare(const ScanBeams& scan, const mrpt::math::TPose2D& robot, const OccupancyGrid& grid);

/// The poses (map frame, best first) at which most beams end at walls, on a lattice of 0.2 m and 2 deg over
/// the free cells of the map within 500 m; at most one within 0.5 m and 10 deg. To be refined by a scan
/// match.
/// @param around    centre of the search (m, map frame)
/// @param headings  search only within 6 deg of these (rad); empty: all headings
/// @param count     maximum number of poses
std::vector<mrpt::math::TPose2D> globalSearch(const ScanBeams& scan, const OccupancyGrid& grid,
                                              const mrpt::math::TPoint2D& around,
                                              const std::vector<double>& headings, size_t count);

}  // namespace hybrid_slam
