#include "slam/plan/WallPairs.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/PointIndex.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr double kThickest = 0.4;                     // m
constexpr double kSteepestPair = mrpt::DEG2RAD(5.0);  // rad: allowed for short faces, beyond their covariance

/// Length (m) by which the faces overlap.
double overlap(const PlanWall& a, const PlanWall& b) {
  const double from = a.line.along(b.end), to = a.line.along(b.start);
  return std::min(to, a.line.along(a.end)) - std::max(from, a.line.along(a.start));
}

/// Distance (m) between two faces that may belong to one wall; 0 if they cannot.
double thickness(const PlanWall& a, const PlanWall& b, const GridProbe& probe) {
  if (std::abs(std::remainder(a.line.angle - b.line.angle + M_PI, 2 * M_PI)) > kSteepestPair) return 0;
  const double shared = overlap(a, b);
  if (shared < std::min(a.length(), b.length()) / 2) return 0;
  const double from = std::max(a.line.along(a.start), a.line.along(b.end));
  const TPoint2D p = a.line.point(from + shared / 2);
  const double behind = b.line.offset(p) < 0 ? -b.line.offset(p) : 0;
  if (behind < 0.02 || behind > kThickest) return 0;
  const TPoint2D across(std::sin(a.line.angle), -std::cos(a.line.angle));
  int free = 0;
  for (int i = 0; i < 8; ++i) {
    const TPoint2D q = a.line.point(from + shared * (i + 0.5) / 8);
    free += probe.at(q + across * (behind / 2)) < 0;
  }
  return free > 2 ? 0 : behind;
}

}  // namespace

void pairFaces(std::vector<PlanWall>& walls, const GridProbe& probe) {
  PointIndex index(kThickest);
  for (size_t i = 0; i < walls.size(); ++i) index.add(walls[i].start, walls[i].end, static_cast<int>(i));
  std::vector<int> best(walls.size(), -1);
  std::vector<double> most(walls.size(), 0), thick(walls.size(), 0);
  std::vector<size_t> lastTried(walls.size(), walls.size());
  for (size_t i = 0; i < walls.size(); ++i) {
    const auto consider = [&](int other) {
      const auto j = static_cast<size_t>(other);
      if (j == i || lastTried[j] == i) return;
      lastTried[j] = i;
      const double between = thickness(walls[i], walls[j], probe);
      const double shared = between > 0 ? overlap(walls[i], walls[j]) : 0;
      if (shared > most[i]) most[i] = shared, best[i] = other, thick[i] = between;
    };
    const int steps = static_cast<int>(walls[i].length() / kThickest) + 1;
    for (int k = 0; k <= steps; ++k)
      index.near(walls[i].start + (walls[i].end - walls[i].start) * (static_cast<double>(k) / steps),
                 consider);
  }
  for (size_t i = 0; i < walls.size(); ++i) {
    if (best[i] < 0 || best[static_cast<size_t>(best[i])] != static_cast<int>(i)) continue;
    walls[i].pair = best[i];
    walls[i].thickness = thick[i];
  }
}

}  // namespace hybrid_slam
