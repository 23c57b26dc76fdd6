/// @file MapTransform.h
/// @brief Transforms a map to another frame and resolution.
#pragma once

#include "slam/filter/MapMaker.h"

namespace hybrid_slam {

/// Transforms a grid to another frame. A cell gets the highest occupancy of the known cells under it.
/// @param frame  the grid's frame in the new one (m, rad)
/// @param cell   size of the new cells, m
OccupancyGrid resampled(const OccupancyGrid& grid, const mrpt::math::TPose2D& frame, double cell);

/// Transforms the lines of a database to another frame.
std::vector<DatabaseLine> transformed(const std::vector<DatabaseLine>& lines,
                                      const mrpt::math::TPose2D& frame);

/// Adds the evidence of another map to each cell, and its lines to the database.
/// @param other  map to add
/// @param frame  its frame in that of `map`
/// @param grid   limits of the probabilities
void addMap(ScanMap& map, const ScanMap& other, const mrpt::math::TPose2D& frame, const GridOptions& grid,
            const AssociationOptions& association, const LineDatabaseOptions& database);

}  // namespace hybrid_slam
