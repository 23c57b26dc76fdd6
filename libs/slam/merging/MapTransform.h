/// @file MapTransform.h
/// @brief Transforms a map to another frame and resolution.
#pragma once

#include "slam/filter/Refinement.h"

namespace hybrid_slam {

/// Transforms a grid to another frame. A cell gets the highest occupancy of the known cells under it.
/// @param frame  the grid's frame in the new one (m, rad)
/// @param cell   size of the new cells, m
OccupancyGrid resampled(const OccupancyGrid& grid, const mrpt::math::TPose2D& frame, double cell);

/// Likewise, the lines of a database.
std::vector<DatabaseLine> transformed(const std::vector<DatabaseLine>& lines,
                                      const mrpt::math::TPose2D& frame);

/// Adds the evidence of another map to each cell, and its lines to the database.
/// @param other   map to add
/// @param frame   its frame in that of `map`
/// @param limits  of the probabilities, and how lines are associated
void addMap(ScanMap& map, const ScanMap& other, const mrpt::math::TPose2D& frame,
            const FilterConfiguration& limits);

}  // namespace hybrid_slam
