/// @file CorrelativeSearch.h
/// @brief Global search for a scan's pose in a grid when odometry is unreliable: E. Olson, "Real-time
/// correlative scan matching", ICRA 2009.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Search range around a predicted pose.
struct SearchWindow {
  double distance = 0;  ///< m, in x and in y
  double angle = 0;     ///< rad
};

/// Local maxima (map frame, best first) of the overlap between the beam end points and the map, on a lattice
/// of 2 cells and 1 deg around `centre`. The map is that of ScanMatcher dilated by one cell, so that a match
/// started at a maximum converges. Uses at most about 120 beams.
/// @param count  maximum number of poses
std::vector<mrpt::math::TPose2D> correlativeSearch(const ScanBeams& scan, const mrpt::math::TPose2D& centre,
                                                   const OccupancyGrid& grid, const SearchWindow& window,
                                                   size_t count);

}  // namespace hybrid_slam
