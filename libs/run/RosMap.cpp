#include "run/RosMap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "run/GreyPicture.h"
#include "run/RosMapFile.h"

namespace hybrid_slam::run {
namespace {

constexpr double kOccupied = 0.97, kFree = 0.03, kUnknown = 0.5;

double occupancyOf(const RosMapFile& map, int grey, bool isTransparent) {
  if (map.mode == RosMapMode::raw)  // percent
    return grey > 100 ? kUnknown : std::clamp(grey / 100., kFree, kOccupied);
  if (map.mode == RosMapMode::scale && isTransparent) return kUnknown;
  const double darkness = (map.isNegated ? grey : 255 - grey) / 255.;
  if (darkness > map.occupiedAbove) return kOccupied;
  if (darkness < map.freeBelow) return kFree;
  if (map.mode == RosMapMode::trinary || map.occupiedAbove == map.freeBelow) return kUnknown;
  return std::clamp((darkness - map.freeBelow) / (map.occupiedAbove - map.freeBelow), kFree, kOccupied);
}

/// Returns the cell value of each grey value.
std::array<int8_t, 256> cellValues(const RosMapFile& map, bool isTransparent) {
  std::array<int8_t, 256> values{};
  for (int grey = 0; grey < 256; ++grey) {
    const double occupied = occupancyOf(map, grey, isTransparent);
    values[static_cast<size_t>(grey)] = static_cast<int8_t>(std::lround(OccupancyGrid::valueOf(occupied)));
  }
  return values;
}

}  // namespace

OccupancyGrid readRosMap(const std::string& file) {
  const RosMapFile map = readRosMapFile(file);
  const GreyPicture picture = readGreyPicture(map.picture);
  const auto opaque = cellValues(map, false), transparent = cellValues(map, true);
  OccupancyGrid grid(map.resolution);
  const int left = static_cast<int>(std::lround(map.x / map.resolution));
  const int bottom = static_cast<int>(std::lround(map.y / map.resolution));
  for (size_t row = 0; row < picture.height; ++row)
    for (size_t column = 0; column < picture.width; ++column) {
      const size_t i = picture.index(column, row);
      const bool isTransparent = !picture.isTransparent.empty() && picture.isTransparent[i];
      const int8_t value = (isTransparent ? transparent : opaque)[picture.grey[i]];
      if (value == 0) continue;
      const CellIndex cell{left + static_cast<int>(column),
                           bottom + static_cast<int>(picture.height - 1 - row)};
      grid.tiles().set(cell, value);
    }
  return grid;
}

}  // namespace hybrid_slam::run
