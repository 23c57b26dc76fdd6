#include "slam/loops/LocalMap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr int8_t kLocalWall = 7;  // log-odds, in units of a cell: more than one hit

struct End {
  uint64_t cell;
  size_t order;
  TPoint2D at;
};

uint64_t keyOf(const CellIndex& cell) {
  return static_cast<uint64_t>(static_cast<uint32_t>(cell.x)) << 32 |
         static_cast<uint64_t>(static_cast<uint32_t>(cell.y));
}

ScanBeams beamsTo(const std::vector<End>& ends) {
  LaserScan scan;
  for (const End& end : ends) {
    Beam beam;
    beam.angle = std::atan2(end.at.y, end.at.x), beam.range = std::hypot(end.at.x, end.at.y);
    beam.valid = true;
    scan.beams.push_back(beam);
  }
  return ScanBeams(scan);
}

/// Keeps the first end in each cell, in their order.
std::vector<End> onePerCell(std::vector<End> ends) {
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.order < b.order;
  });
  ends.erase(
      std::unique(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.cell == b.cell; }),
      ends.end());
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.order < b.order; });
  return ends;
}

}  // namespace

LocalMap localMap(const std::vector<Keyframe>& keyframes, const std::vector<TPose2D>& poses, size_t first,
                  size_t last, const GridOptions& options) {
  const size_t reference = (first + last) / 2;
  OccupancyGrid grid(options.resolution);
  std::vector<End> ends;
  for (size_t k = first; k < last; ++k) {
    const TPose2D pose = poses[k] - poses[reference];
    const ScanBeams& beams = keyframes[k].beams;
    grid.insert(beams, pose, options);
    const double c = std::cos(pose.phi), s = std::sin(pose.phi);
    for (const ScanBeams::Ray& ray : beams.rays) {
      const TPoint2D& origin = beams.origins[ray.laser];
      const double x = origin.x + ray.range * ray.dirX, y = origin.y + ray.range * ray.dirY;
      const TPoint2D end(pose.x + x * c - y * s, pose.y + x * s + y * c);
      const CellIndex cell = grid.cellOf(end.x, end.y);
      ends.push_back({keyOf(cell), ends.size(), end});
    }
  }
  return {reference, std::move(grid), beamsTo(onePerCell(std::move(ends)))};
}

LocalMap localMap(const OccupancyGrid& map, const TPoint2D& place, double reach, double resolution) {
  const CellIndex min = map.cellOf(place.x - reach, place.y - reach),
                  max = map.cellOf(place.x + reach, place.y + reach);
  LocalMap local{PoseEdge::kMapFrame, OccupancyGrid(resolution), ScanBeams()};
  TileGrid& cells = local.grid.tiles();
  map.tiles().forEachTile([&](int tx, int ty, const Tile& tile) {
    const int left = tx * Tile::kSize, low = ty * Tile::kSize;
    for (int y = std::max(low, min.y); y <= std::min(low + Tile::kSize - 1, max.y); ++y)
      for (int x = std::max(left, min.x); x <= std::min(left + Tile::kSize - 1, max.x); ++x) {
        const int8_t value = tile.cells()[Tile::index(x, y)];
        if (value == 0) continue;
        const CellIndex cell = local.grid.cellOf((x + 0.5) * map.resolution(), (y + 0.5) * map.resolution());
        const int8_t before = cells.at(cell);
        // A wall is thinner than a coarse cell; free space must be free in all of it that is known.
        if (before == 0 || value > before) cells.set(cell, value);
      }
  });
  std::vector<End> ends;
  cells.forEachTile([&](int tx, int ty, const Tile& tile) {
    for (int i = 0; i < Tile::kSize * Tile::kSize; ++i) {
      const int x = tx * Tile::kSize + i % Tile::kSize, y = ty * Tile::kSize + i / Tile::kSize;
      if (tile.cells()[Tile::index(x, y)] < kLocalWall) continue;
      const auto key = keyOf({x, y});
      ends.push_back({key, ends.size(), TPoint2D((x + 0.5) * resolution, (y + 0.5) * resolution)});
    }
  });
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.cell < b.cell; });
  local.ends = beamsTo(ends);
  return local;
}

}  // namespace hybrid_slam
