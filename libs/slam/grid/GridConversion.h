/// @file GridConversion.h
/// @brief Converts to and from MRPT's occupancy grid, exact to the cell.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Largest number of cells of an MRPT grid, which computes sizes in 32 bits: 256 MiB.
constexpr size_t kMostCells = size_t{1} << 28;

/// All cells ever written, plus a margin of one cell. The cell values are the same log-odds with MRPT's sign
/// (positive is free).
/// @param mostCells  a larger map gets coarser cells: n x n cells become one, with the highest known
///                   occupancy and the smallest sufficient n
mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, size_t mostCells = kMostCells);

/// Converts only the cells of `box`.
/// @throws InputError for more than kMostCells
mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, const CellBox& box);

/// Converts from MRPT's grid. The resolution is the shortest decimal number that gives MRPT's float: 0.05,
/// not 0.0500000007.
/// @throws InputError if the origin of MRPT's grid is not a whole number of cells from the map's origin
OccupancyGrid fromMrpt(const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace hybrid_slam
