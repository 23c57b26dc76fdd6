/// @file WallErrors.h
/// @brief Distance of a grid map's occupied cells to the true walls.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

#include "study/simulation/BuildingPlan.h"

namespace mrpt::maps {
class COccupancyGridMap2D;
}

namespace hybrid_slam::comparison {

/// Centres of the cells with an occupancy above 0.65, as for ROS's map_server; m, in the map's frame, row by
/// row.
std::vector<mrpt::math::TPoint2D> occupiedCells(const mrpt::maps::COccupancyGridMap2D& map);

/// Distances from the centres of the occupied cells to the nearest wall, m.
struct WallErrors {
  double mean = 0, p95 = 0;
};

/// @param alignment  of the map's frame in the floor plan's: rigid alignment of the trajectory to the
///                   reference
/// @throws std::runtime_error for a map without occupied cells
WallErrors wallErrors(const mrpt::maps::COccupancyGridMap2D& map, const simulation::BuildingPlan& plan,
                      const mrpt::math::TPose2D& alignment);

}  // namespace hybrid_slam::comparison
