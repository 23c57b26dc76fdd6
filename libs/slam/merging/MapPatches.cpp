#include "slam/merging/MapPatches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/grid/GlobalSearch.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kSide = 12, kSpacing = 4;  // m
constexpr double kLeastWall = 4;            // m
constexpr size_t kMost = 250;
constexpr int8_t kWall = 7;  // 0.6, in units of a cell

/// The known cells of a box, and their walls as beam ends.
MapPatch cut(const OccupancyGrid& grid, const CellBox& box, const CellIndex& origin) {
  const double size = grid.resolution();
  MapPatch patch{{origin.x * size, origin.y * size, 0}, {0, OccupancyGrid(size), ScanBeams()}};
  patch.map.ends.origins.emplace_back(0, 0);
  TileReader reader(grid.tiles());
  for (int y = box.min.y; y <= box.max.y; ++y)
    for (int x = box.min.x; x <= box.max.x; ++x) {
      const int8_t value = reader.at(x, y);
      if (value == 0) continue;
      const CellIndex cell{x - origin.x, y - origin.y};
      patch.map.grid.tiles().set(cell, value);
      if (value < kWall) continue;
      const double ex = (cell.x + 0.5) * size, ey = (cell.y + 0.5) * size, range = std::hypot(ex, ey);
      patch.map.ends.rays.push_back({ex / range, ey / range, range, 0});
    }
  return patch;
}

}  // namespace

TPoint2D middleOf(const OccupancyGrid& grid) {
  const CellBox box = grid.tiles().bounds();
  return {0.5 * (box.min.x + box.max.x) * grid.resolution(),
          0.5 * (box.min.y + box.max.y) * grid.resolution()};
}

MapPatch wholeMap(const OccupancyGrid& grid, const TPose2D& place) {
  return cut(grid, grid.tiles().bounds(), grid.cellOf(place.x, place.y));
}

std::vector<MapPatch> patchesOf(const OccupancyGrid& grid) {
  const GlobalSearch map(grid, middleOf(grid));
  std::vector<TPoint2D> places = map.freePlaces(kSpacing);
  for (double spacing = kSpacing; places.size() > kMost;) places = map.freePlaces(spacing *= 1.2);
  const int reach = static_cast<int>(0.5 * kSide / grid.resolution());
  std::vector<MapPatch> patches;
  for (const TPoint2D& place : places) {
    const CellIndex at = grid.cellOf(place.x, place.y);
    patches.push_back(cut(grid, {{at.x - reach, at.y - reach}, {at.x + reach, at.y + reach}}, at));
    if (static_cast<double>(patches.back().map.ends.rays.size()) * grid.resolution() < kLeastWall)
      patches.pop_back();
  }
  return patches;
}

}  // namespace hybrid_slam
