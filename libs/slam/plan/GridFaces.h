/// @file GridFaces.h
/// @brief The faces of walls in a grid: straight pieces of the border between free and occupied cells.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"
#include "slam/plan/LineEstimate.h"

namespace hybrid_slam {

/// A straight piece of a wall's face with the free side on the left of start -> end.
struct Face {
  mrpt::math::TPoint2D start, end;  ///< m, map frame, on the line
  LineEstimate line;
  int count = 0;  ///< observations of its line in the database

  double length() const { return (end - start).norm(); }
};

/// The borders between occupied and free cells, split where they bend (Douglas & Peucker 1973). The line of
/// a piece is fitted to the occupied cells behind it, weighted by their log-odds, and so is finer than a
/// cell.
std::vector<Face> facesOf(const OccupancyGrid& grid);

}  // namespace hybrid_slam
