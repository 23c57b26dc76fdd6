/// @file PathRelaxation.h
/// @brief Distributes the small errors of a path over its loops.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

#include "base/LaserScan.h"
#include "slam/filter/FilterOptions.h"

namespace hybrid_slam {

/// When the robot returns, a filter matches its scans to the old walls. The error that the path has collected
/// on the way, some centimetres, stays where the two visits meet. Matching every scan to the map of all scans
/// does not distribute it: the walls of each visit hold the scans of that visit.
///
/// So scans taken on a return are matched to a map of the earlier visit alone, two per metre of path
/// (`returnMatches`), and all motions are tracked on a map of the latest scans alone. The pose graph of both
/// moves the path. Matches that disagree with the others lose weight (Cauchy's weight function). The first
/// pose is fixed. A path that does not return stays as it is.
///
/// With a drift of half a metre, the search for slips finds the robot among the old walls, and the path jumps
/// there. If the odometry of this motion fits the latest scans better, it is taken instead.
/// @param path      a pose for each update, map frame
/// @param odometry  the motion from each update to the next one, at the index of the next (m, rad; in the
///                  frame of the earlier pose); zero for the first
/// @param scans     of each update; those of the last ones may be missing
std::vector<mrpt::math::TPose2D> relaxed(const std::vector<mrpt::math::TPose2D>& path,
                                         const std::vector<mrpt::math::TPose2D>& odometry,
                                         const std::vector<Scans>& scans,
                                         const FilterConfiguration& configuration);

}  // namespace hybrid_slam
