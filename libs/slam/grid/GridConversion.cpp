#include "slam/grid/GridConversion.h"

#include <algorithm>
#include <cmath>

#include "base/Errors.h"

namespace hybrid_slam {

mrpt::maps::COccupancyGridMap2D toMrpt(const OccupancyGrid& grid, const CellBox& wanted) {
  CellBox box = wanted;
  if (box.empty()) {
    box = grid.tiles().bounds();
    if (box.empty()) box = {{0, 0}, {0, 0}};
    box.min = {box.min.x - 1, box.min.y - 1};
    box.max = {box.max.x + 1, box.max.y + 1};
  }
  const double s = grid.resolution();
  mrpt::maps::COccupancyGridMap2D out;
  out.setSize(static_cast<float>(box.min.x * s), static_cast<float>((box.max.x + 1) * s),
              static_cast<float>(box.min.y * s), static_cast<float>((box.max.y + 1) * s),
              static_cast<float>(s), 0.5f);
  TileReader cells(grid.tiles());
  const int width = static_cast<int>(out.getSizeX()), height = static_cast<int>(out.getSizeY());
  for (int y = 0; y < height; ++y) {
    auto* row = out.getRow(y);
    for (int x = 0; x < width; ++x)
      row[x] = static_cast<int8_t>(-std::max<int>(cells.at(box.min.x + x, box.min.y + y), -127));
  }
  return out;
}

OccupancyGrid fromMrpt(const mrpt::maps::COccupancyGridMap2D& in) {
  const double s = std::round(in.getResolution() * 1e6) / 1e6;  // MRPT stores a float
  OccupancyGrid grid(s);
  const double firstX = in.getXMin() / s, firstY = in.getYMin() / s;
  const int x0 = static_cast<int>(std::lround(firstX)), y0 = static_cast<int>(std::lround(firstY));
  if (std::abs(firstX - x0) > 0.01 || std::abs(firstY - y0) > 0.01)
    throw InputError("grid not aligned", "origin of the occupancy grid",
                     "expected a whole number of cells from (0, 0)");
  for (int y = 0; y < static_cast<int>(in.getSizeY()); ++y) {
    const auto* row = in.getRow(y);
    for (int x = 0; x < static_cast<int>(in.getSizeX()); ++x)
      if (row[x] != 0) grid.tiles().set({x0 + x, y0 + y}, static_cast<int8_t>(-std::max<int>(row[x], -127)));
  }
  return grid;
}

}  // namespace hybrid_slam
