#include "slam/grid/NarrowThings.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/Median.h"
#include "slam/grid/RaySamples.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using Ray = ScanBeams::Ray;

namespace {

constexpr double kWidth = 0.5;  // m
constexpr double kGap = 0.3;    // m, between successive end points of one thing
constexpr double kSteps = 2;    // the same, in distances of two beams

constexpr double kAround = 0.1;       // m, of an end point
constexpr double kSeenThrough = 0.4;  // occupancy

/// Sine of the angle between successive beams of a laser, the median.
double angularStep(const std::vector<Ray>& rays) {
  std::vector<double> steps;
  for (size_t i = 1; i < rays.size(); ++i)
    if (rays[i].laser == rays[i - 1].laser)
      steps.push_back(std::abs(rays[i].dirX * rays[i - 1].dirY - rays[i].dirY * rays[i - 1].dirX));
  return steps.empty() ? 0 : median(std::move(steps));
}

}  // namespace

std::vector<bool> endsAtNarrowThing(const ScanBeams& beams) {
  const std::vector<Ray>& rays = beams.rays;
  const std::vector<TPoint2D> ends = beams.endPoints();
  const double step = angularStep(rays);
  const auto areOneThing = [&](size_t a, size_t b) {
    return rays[a].laser == rays[b].laser &&
           (ends[a] - ends[b]).norm() <
               std::max(kGap, kSteps * step * std::min(rays[a].range, rays[b].range));
  };
  const auto isBehind = [&](size_t other, size_t thing) {
    return other < rays.size() && rays[other].laser == rays[thing].laser &&
           rays[other].range > rays[thing].range;
  };
  std::vector<bool> isNarrow(rays.size(), false);
  for (size_t first = 0, end; first < rays.size(); first = end) {
    for (end = first + 1; end < rays.size() && areOneThing(end - 1, end);) ++end;
    if ((ends[end - 1] - ends[first]).norm() < kWidth &&
        (isBehind(first - 1, first) || isBehind(end, end - 1)))
      std::fill(isNarrow.begin() + static_cast<std::ptrdiff_t>(first),
                isNarrow.begin() + static_cast<std::ptrdiff_t>(end), true);
  }
  return isNarrow;
}

std::vector<bool> endsAtMovedThing(const ScanBeams& beams, const TPose2D& robot, const OccupancyGrid& grid) {
  std::vector<bool> isMoved = endsAtNarrowThing(beams);
  const GridPose frame(robot, beams, grid.resolution());
  const int near = std::max(1, static_cast<int>(std::lround(kAround / grid.resolution())));
  const double free = OccupancyGrid::valueOf(kSeenThrough);
  TileReader cells(grid.tiles());
  const auto endsInFreeSpace = [&](const Ray& ray) {
    const double range = ray.range / grid.resolution();
    const int x = floorOf(frame.origin(ray).x + range * frame.dirX(ray));
    const int y = floorOf(frame.origin(ray).y + range * frame.dirY(ray));
    for (int j = -near; j <= near; ++j)
      for (int i = -near; i <= near; ++i)
        if (cells.at(x + i, y + j) > free) return false;
    return true;
  };
  for (size_t i = 0; i < isMoved.size(); ++i) isMoved[i] = isMoved[i] && endsInFreeSpace(beams.rays[i]);
  return isMoved;
}

LaserScans without(LaserScans scans, const std::vector<bool>& beams) {
  auto isLeftOut = beams.begin();
  for (LaserScan& scan : scans)
    for (Beam& beam : scan.beams)
      if (beam.valid) beam.valid = !*isLeftOut++;
  return scans;
}

}  // namespace hybrid_slam
