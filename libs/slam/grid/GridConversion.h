/// @file GridConversion.h
/// @brief To and from MRPT's occupancy grid, exact to the cell.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// MRPT's grid over the cells `box` (if empty: all cells ever written, plus a margin of one cell). The cell
/// values are the same log-odds with MRPT's sign (positive is free).
mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, const CellBox& box = {});

/// @throws InputError if the origin of MRPT's grid is not a whole number of cells from the map's origin
OccupancyGrid fromMrpt(const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace hybrid_slam
