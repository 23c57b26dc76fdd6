#include "slam/loops/LocalMap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

struct End {
  uint64_t cell;
  size_t order;
  TPoint2D at;
};

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
      const uint64_t key = static_cast<uint64_t>(static_cast<uint32_t>(cell.x)) << 32 |
                           static_cast<uint64_t>(static_cast<uint32_t>(cell.y));
      ends.push_back({key, ends.size(), end});
    }
  }
  LaserScan scan;
  for (const End& end : onePerCell(std::move(ends))) {
    Beam beam;
    beam.angle = std::atan2(end.at.y, end.at.x), beam.range = std::hypot(end.at.x, end.at.y),
    beam.valid = true;
    scan.beams.push_back(beam);
  }
  return {reference, std::move(grid), ScanBeams(scan)};
}

}  // namespace hybrid_slam
