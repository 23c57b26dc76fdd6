/// @file WallErrors.h
/// @brief A grid map against the walls it should show: how far off its occupied cells are, and how much of
/// the walls it shows twice.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "simulation/FloorPlan.h"

namespace mrpt::maps {
class COccupancyGridMap2D;
}

namespace hybrid_slam {

/// Centres of the cells with an occupancy above 0.65, as for ROS's map_server; m, in the map's frame, row by
/// row.
std::vector<mrpt::math::TPoint2D> occupiedCells(const mrpt::maps::COccupancyGridMap2D& map);

struct WallErrors {
  double mean = 0, p95 = 0;  ///< m, from the centres of occupied cells to the nearest wall
  double doubledShare = 0;   ///< of the free-standing wall that the map shows, in [0, 1]
};

/// Doubled wall: every straight wall is sampled each 0.1 m. At a sample the map is read along the wall's
/// normal, up to 1 m to both sides. The sample is *free-standing* if that normal up to 1.5 m comes no nearer
/// than 0.5 m to another wall (nearer than to the sample itself), so that one row of occupied cells is
/// expected. It is *shown* if any cell there is occupied, and *spread* if the occupied ones reach over more
/// than 0.2 m. It is *doubled* if it is spread and belongs to at least 3 such samples in a row, which stray
/// cells do not make. The share is doubled / shown, 0 for a map that shows no such wall. A map that is bent
/// as a whole, by up to the 1 m, is not doubled; its errors are in `mean` and `p95`.
///
/// @param alignment  the map's frame in the floor plan's: the rigid alignment of the trajectory to the
/// reference
/// @throws std::runtime_error for a map without occupied cells
WallErrors wallErrors(const mrpt::maps::COccupancyGridMap2D& map, const FloorPlan& plan,
                      const mrpt::math::TPose2D& alignment);

/// Reads `map.gridmap.gz`.
/// @throws std::runtime_error if it cannot be read
mrpt::maps::COccupancyGridMap2D loadGridMap(const std::string& file);

}  // namespace hybrid_slam
