/// @file PictureRoom.h
/// @brief For the tests of map files: a room in MRPT's grid.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

namespace hybrid_slam::test {

/// A room of 4 m x 2 m from (1, -3) on, its walls one cell thick, free inside, nothing known outside.
inline mrpt::maps::COccupancyGridMap2D pictureRoom(float cell) {
  mrpt::maps::COccupancyGridMap2D grid;
  grid.setSize(-2, 8, -6, 4, cell, 0.5f);
  const auto fill = [&grid](double x0, double y0, double x1, double y1, float free) {
    for (int x = grid.x2idx(x0); x <= grid.x2idx(x1); ++x)
      for (int y = grid.y2idx(y0); y <= grid.y2idx(y1); ++y) grid.setCell(x, y, free);
  };
  const double inside = 1.2 * cell, middle = 0.5 * cell;
  fill(1 + middle, -3 + middle, 5 + middle, -1 + middle, 0.03f);
  fill(1 + middle + inside, -3 + middle + inside, 5 + middle - inside, -1 + middle - inside, 0.97f);
  return grid;
}

}  // namespace hybrid_slam::test
