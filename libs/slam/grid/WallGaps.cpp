#include "slam/grid/WallGaps.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;

namespace {

double cross(const TPoint2D& a, const TPoint2D& b) { return a.x * b.y - a.y * b.x; }

/// The sine of the angle between the beams i and i + 1.
double sineToNext(const ScanBeams& scan, size_t i) {
  const auto &a = scan.rays[i], &b = scan.rays[i + 1];
  return std::abs(cross({a.dirX, a.dirY}, {b.dirX, b.dirY}));
}

}  // namespace

std::vector<size_t> wallGaps(const ScanBeams& scan, double longest) {
  // m; several times the noise of common lasers. Where beams graze a wall, the mouths of shallow niches are
  // filled too, which makes paths slightly too long. A tolerance along the beams would avoid this, but leave
  // few gaps in corridors with many niches.
  constexpr double kStraight = 0.05;
  constexpr double kNext = 1.5;    // of the spacing beside: a missing beam doubles it
  constexpr double kBeside = 1.5;  // of the gap: the end points before and after are of the same wall
  const std::vector<TPoint2D> ends = scan.endPoints();
  std::vector<size_t> gaps;
  for (size_t i = 1; i + 2 < ends.size(); ++i) {
    if (scan.rays[i - 1].laser != scan.rays[i + 2].laser) continue;
    const TPoint2D &before = ends[i - 1], &from = ends[i], &to = ends[i + 1], &after = ends[i + 2];
    const double length = (to - from).norm(), across = (after - before).norm();
    if (length > longest || across > (1 + 2 * kBeside) * length) continue;
    const double spacing = std::min(sineToNext(scan, i - 1), sineToNext(scan, i + 1));
    if (sineToNext(scan, i) > kNext * spacing) continue;
    const auto isOnLine = [&](const TPoint2D& point) {
      return std::abs(cross(after - before, point - before)) <= kStraight * across;
    };
    if (isOnLine(from) && isOnLine(to)) gaps.push_back(i);
  }
  return gaps;
}

}  // namespace hybrid_slam
