/// @file GridProbe.h
/// @brief Reads the occupancy of a grid at points and along stretches.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// The grid must outlive it. Not for several threads at a time: it caches the last tile.
class GridProbe {
 public:
  explicit GridProbe(const OccupancyGrid& grid) : grid_(grid), reader_(grid.tiles()) {}

  double cell() const { return grid_.resolution(); }  ///< m
  /// Log-odds in steps of OccupancyGrid::kLogOddsScale; above 0: occupied, 0: unknown.
  int at(const mrpt::math::TPoint2D& p) const {
    const CellIndex c = grid_.cellOf(p.x, p.y);
    return reader_.at(c.x, c.y);
  }
  int at(int x, int y) const { return reader_.at(x, y); }

  /// Share of the stretch from a to b that lies in free cells, 0..1; 0 if it is shorter than half a cell.
  double freeShare(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) const {
    const int steps = static_cast<int>((b - a).norm() / cell() * 2);
    int free = 0;
    for (int i = 0; i < steps; ++i) free += at(a + (b - a) * ((i + 0.5) / steps)) < 0;
    return steps > 0 ? static_cast<double>(free) / steps : 0;
  }

 private:
  const OccupancyGrid& grid_;
  mutable TileReader reader_;
};

}  // namespace hybrid_slam
