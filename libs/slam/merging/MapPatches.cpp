#include "slam/merging/MapPatches.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "slam/grid/GlobalSearch.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kSide = 12, kSpacing = 4;  // m
constexpr double kLeastWall = 4;            // m
constexpr size_t kMost = 250;
constexpr int8_t kWall = 7;  // 0.6, in units of a cell

struct KnownCell {
  int y, x;
  int8_t value;
};

/// Returns the known cells of a box, row by row. Visits existing tiles only: a map may have few, far apart.
std::vector<KnownCell> knownCells(const TileGrid& tiles, const CellBox& box) {
  std::vector<KnownCell> cells;
  tiles.forEachTile([&](int tx, int ty, const Tile& tile) {
    const int left = tx * Tile::kSize, low = ty * Tile::kSize;
    for (int y = std::max(low, box.min.y); y <= std::min(low + Tile::kSize - 1, box.max.y); ++y)
      for (int x = std::max(left, box.min.x); x <= std::min(left + Tile::kSize - 1, box.max.x); ++x)
        if (const int8_t value = tile.cells()[Tile::index(x, y)]; value != 0) cells.push_back({y, x, value});
  });
  std::sort(cells.begin(), cells.end(),
            [](const KnownCell& a, const KnownCell& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
  return cells;
}

/// Cuts out the known cells of a box, with their walls as beam ends.
MapPatch cut(const OccupancyGrid& grid, const CellBox& box, const CellIndex& origin) {
  const double size = grid.resolution();
  MapPatch patch{{origin.x * size, origin.y * size, 0}, {0, OccupancyGrid(size), ScanBeams()}};
  patch.map.ends.origins.emplace_back(0, 0);
  for (const auto& [y, x, value] : knownCells(grid.tiles(), box)) {
    const CellIndex cell{x - origin.x, y - origin.y};
    patch.map.grid.tiles().set(cell, value);
    if (value < kWall) continue;
    const double ex = (cell.x + 0.5) * size, ey = (cell.y + 0.5) * size, range = std::hypot(ex, ey);
    patch.map.ends.rays.push_back({ex / range, ey / range, range, 0});
  }
  return patch;
}

}  // namespace

MapPatch wholeMap(const OccupancyGrid& grid, const TPose2D& place) {
  return cut(grid, grid.tiles().bounds(), grid.cellOf(place.x, place.y));
}

std::vector<MapPatch> patchesOf(const OccupancyGrid& grid) {
  const GlobalSearch map(grid, grid.middle());
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
