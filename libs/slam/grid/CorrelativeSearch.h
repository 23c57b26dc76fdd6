/// @file CorrelativeSearch.h
/// @brief Where a scan may lie in a grid when the odometry cannot be trusted: E. Olson, "Real-time
/// correlative scan matching", ICRA 2009.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// How far around a predicted pose the robot may be.
struct SearchWindow {
  double distance = 0;  ///< m, in x and in y
  double angle = 0;     ///< rad
};

/// The places (map frame), best first, where the ends of the beams meet most of the map, each the best among
/// its neighbours: on a lattice of 2 cells and 1 deg around `centre`, over the map of ScanMatcher widened by
/// a cell, so that each place is within a climb's reach. At most about 120 beams are taken.
/// @param count  at most so many
std::vector<mrpt::math::TPose2D> correlativeSearch(const ScanBeams& scan, const mrpt::math::TPose2D& centre,
                                                   const OccupancyGrid& grid, const SearchWindow& window,
                                                   size_t count);

}  // namespace hybrid_slam
