/// @file GridConversion.h
/// @brief To and from MRPT's occupancy grid, exact to the cell.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Cells of the largest grid for MRPT, which computes sizes in 32 bits: 256 MiB.
constexpr size_t kMostCells = size_t{1} << 28;

/// All cells ever written, plus a margin of one cell. The cell values are the same log-odds with MRPT's sign
/// (positive is free).
/// @param mostCells  a larger map gets coarser cells: n x n become one with the highest occupancy of those
///                   known, with the smallest n that suffices
mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, size_t mostCells = kMostCells);

/// Likewise the cells of `box`.
/// @throws InputError for more than kMostCells
mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, const CellBox& box);

/// The resolution is the shortest decimal number that gives MRPT's float: 0.05, not 0.0500000007.
/// @throws InputError if the origin of MRPT's grid is not a whole number of cells from the map's origin
OccupancyGrid fromMrpt(const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace hybrid_slam
