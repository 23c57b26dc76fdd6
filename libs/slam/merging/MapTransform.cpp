#include "slam/merging/MapTransform.h"

#include <algorithm>
#include <cmath>

#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

/// Returns the cells of the new grid that a tile of the old one may touch.
CellBox boxOf(int tx, int ty, double size, const TPose2D& frame, const OccupancyGrid& target) {
  CellBox box;
  for (int corner = 0; corner < 4; ++corner) {
    const TPoint2D at = frame.composePoint(
        TPoint2D(Tile::kSize * size * (tx + (corner & 1)), Tile::kSize * size * (ty + (corner >> 1))));
    const CellIndex cell = target.cellOf(at.x, at.y);
    if (corner == 0) box = {cell, cell};
    box.min = {std::min(box.min.x, cell.x), std::min(box.min.y, cell.y)};
    box.max = {std::max(box.max.x, cell.x), std::max(box.max.y, cell.y)};
  }
  return box;
}

}  // namespace

OccupancyGrid resampled(const OccupancyGrid& grid, const TPose2D& frame, double cell) {
  OccupancyGrid result(cell);
  // A cell that covers many smaller ones is sampled, not searched completely.
  const int samples = static_cast<int>(std::clamp(std::round(cell / grid.resolution()), 1.0, 16.0));
  const double c = std::cos(frame.phi), s = std::sin(frame.phi), step = cell / samples;
  TileReader reader(grid.tiles());
  const auto valueAt = [&](double x, double y) {
    x -= frame.x, y -= frame.y;
    return reader.at(static_cast<int>(std::floor((c * x + s * y) / grid.resolution())),
                     static_cast<int>(std::floor((c * y - s * x) / grid.resolution())));
  };
  grid.tiles().forEachTile([&](int tx, int ty, const Tile&) {
    const CellBox box = boxOf(tx, ty, grid.resolution(), frame, result);
    for (int y = box.min.y; y <= box.max.y; ++y)
      for (int x = box.min.x; x <= box.max.x; ++x) {
        int8_t highest = 0;
        for (int k = 0; k < samples * samples; ++k) {
          const int column = k % samples, row = k / samples;
          const int8_t value = valueAt(x * cell + (column + 0.5) * step, y * cell + (row + 0.5) * step);
          if (value != 0 && (highest == 0 || value > highest)) highest = value;
        }
        if (highest != 0) result.tiles().set({x, y}, highest);
      }
  });
  return result;
}

std::vector<DatabaseLine> transformed(const std::vector<DatabaseLine>& lines, const TPose2D& frame) {
  std::vector<DatabaseLine> all = lines;
  for (DatabaseLine& line : all) {
    static_cast<LineSegment&>(line) = transformed(static_cast<const LineSegment&>(line), frame);
    line.direction = wrapToRightAngle(line.direction + frame.phi);
  }
  return all;
}

void addMap(ScanMap& map, const ScanMap& other, const TPose2D& frame, const GridOptions& grid,
            const AssociationOptions& association, const LineDatabaseOptions& database) {
  const OccupancyGrid moved = resampled(other.grid, frame, map.grid.resolution());
  TileGrid& cells = map.grid.tiles();
  moved.tiles().forEachTile([&](int tx, int ty, const Tile& tile) {
    for (int y = ty * Tile::kSize; y < (ty + 1) * Tile::kSize; ++y)
      for (int x = tx * Tile::kSize; x < (tx + 1) * Tile::kSize; ++x)
        if (const int value = tile.cells()[Tile::index(x, y)]; value != 0)
          cells.set({x, y}, static_cast<int8_t>(std::clamp(cells.at({x, y}) + value, -127, 127)));
  });
  map.grid.limit(grid.pMin, grid.pMax);

  std::vector<DatabaseLine> lines = map.lines.lines();
  for (const DatabaseLine& line : transformed(other.lines.lines(), frame)) {
    const DatabaseLine* known = map.lines.closestMatch(line, association);
    if (!known) {
      lines.push_back(line);
      continue;
    }
    DatabaseLine& same = lines[static_cast<size_t>(known - map.lines.lines().data())];
    same = merged(same, line, line.count);
  }
  setDirections(lines, database.directionWindow);
  map.lines = LineDatabase(std::move(lines));
}

}  // namespace hybrid_slam
