#include "slam/grid/GridConversion.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/Errors.h"
#include "base/Memory.h"
#include "base/Numbers.h"

namespace hybrid_slam {

namespace {

/// Index of the merged cell that holds a cell.
int merged(int cell, int merge) { return (cell < 0 ? cell - merge + 1 : cell) / merge; }

double cellsOf(const CellBox& box) {
  return (static_cast<double>(box.max.x) - box.min.x + 1) * (static_cast<double>(box.max.y) - box.min.y + 1);
}

mrpt::maps::COccupancyGridMap2D unknownGrid(const CellBox& box, double s) {
  expectMemory(2 * static_cast<size_t>(cellsOf(box)));
  mrpt::maps::COccupancyGridMap2D out;
  out.setSize(static_cast<float>(box.min.x * s), static_cast<float>((box.max.x + 1) * s),
              static_cast<float>(box.min.y * s), static_cast<float>((box.max.y + 1) * s),
              static_cast<float>(s), 0.5f);
  return out;
}

int8_t mrptValue(int8_t value) { return static_cast<int8_t>(-std::max<int>(value, -127)); }

/// The shortest decimal number that is this float: 0.05, not 0.0500000007.
double shortest(float value) {
  char text[64];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return *parseNumber({text, static_cast<size_t>(end - text)});
}

}  // namespace

mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, size_t mostCells) {
  CellBox known = grid.tiles().bounds();
  if (known.empty()) known = {{0, 0}, {0, 0}};
  const auto boxOf = [&known](int merge) {
    return CellBox{{merged(known.min.x, merge) - 1, merged(known.min.y, merge) - 1},
                   {merged(known.max.x, merge) + 1, merged(known.max.y, merge) + 1}};
  };
  int merge = 1;
  while (cellsOf(boxOf(merge)) > static_cast<double>(mostCells)) ++merge;

  const CellBox box = boxOf(merge);
  mrpt::maps::COccupancyGridMap2D out = unknownGrid(box, merge * grid.resolution());
  const int width = static_cast<int>(out.getSizeX()), height = static_cast<int>(out.getSizeY());
  grid.tiles().forEachTile([&](int tx, int ty, const Tile& tile) {
    for (int j = 0; j < Tile::kSize; ++j) {
      const int y = merged(ty * Tile::kSize + j, merge) - box.min.y;
      if (y >= height) continue;  // MRPT rounds the size in floats
      auto* row = out.getRow(y);
      for (int i = 0; i < Tile::kSize; ++i) {
        const int8_t value = tile.cells()[Tile::index(i, j)];
        const int x = merged(tx * Tile::kSize + i, merge) - box.min.x;
        if (value == 0 || x >= width) continue;
        row[x] = row[x] == 0 ? mrptValue(value) : std::min(row[x], mrptValue(value));
      }
    }
  });
  return out;
}

mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, const CellBox& box) {
  if (cellsOf(box) > static_cast<double>(kMostCells))
    throw InputError("scan too long for this cell size", "section [grid], key `max_range`",
                     "expected less than 2^28 cells around the robot");
  mrpt::maps::COccupancyGridMap2D out = unknownGrid(box, grid.resolution());
  TileReader cells(grid.tiles());
  const int width = static_cast<int>(out.getSizeX()), height = static_cast<int>(out.getSizeY());
  for (int y = 0; y < height; ++y) {
    auto* row = out.getRow(y);
    for (int x = 0; x < width; ++x) row[x] = mrptValue(cells.at(box.min.x + x, box.min.y + y));
  }
  return out;
}

OccupancyGrid fromMrpt(const mrpt::maps::COccupancyGridMap2D& in) {
  const double s = shortest(in.getResolution());
  OccupancyGrid grid(s);
  const double firstX = in.getXMin() / s, firstY = in.getYMin() / s;
  const int x0 = static_cast<int>(std::lround(firstX)), y0 = static_cast<int>(std::lround(firstY));
  const auto isOff = [](double first, int cell) {
    constexpr double kFloat = 1. / (1 << 22);  // relative accuracy of MRPT's numbers
    return std::abs(first - cell) > 0.01 + std::abs(first) * kFloat;
  };
  if (isOff(firstX, x0) || isOff(firstY, y0))
    throw InputError("grid not aligned", "origin of the occupancy grid",
                     "expected a whole number of cells from (0, 0)");
  for (int y = 0; y < static_cast<int>(in.getSizeY()); ++y) {
    const auto* row = in.getRow(y);
    for (int x = 0; x < static_cast<int>(in.getSizeX()); ++x)
      if (row[x] != 0) grid.tiles().set({x0 + x, y0 + y}, mrptValue(row[x]));
  }
  return grid;
}

}  // namespace hybrid_slam
