#include "slam/loops/LocalMap.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

LocalMap localMap(const std::vector<Keyframe>& keyframes, const std::vector<TPose2D>& poses, size_t first,
                  size_t last, const GridOptions& options) {
  const size_t reference = (first + last) / 2;
  OccupancyGrid grid(options.resolution);
  LaserScan ends;
  std::unordered_map<uint64_t, size_t> seen;
  for (size_t k = first; k < last; ++k) {
    const TPose2D pose = poses[k] - poses[reference];
    const ScanBeams& beams = keyframes[k].beams;
    grid.insert(beams, pose, options);
    for (const ScanBeams::Ray& ray : beams.rays) {
      const TPoint2D& origin = beams.origins[ray.laser];
      const TPoint2D end =
          pose.composePoint(TPoint2D(origin.x + ray.range * ray.dirX, origin.y + ray.range * ray.dirY));
      const CellIndex cell = grid.cellOf(end.x, end.y);
      const uint64_t key = static_cast<uint64_t>(static_cast<uint32_t>(cell.x)) << 32 |
                           static_cast<uint64_t>(static_cast<uint32_t>(cell.y));
      if (!seen.emplace(key, ends.beams.size()).second) continue;
      Beam beam;
      beam.angle = std::atan2(end.y, end.x), beam.range = std::hypot(end.x, end.y), beam.valid = true;
      ends.beams.push_back(beam);
    }
  }
  return {reference, std::move(grid), ScanBeams(ends)};
}

}  // namespace hybrid_slam
