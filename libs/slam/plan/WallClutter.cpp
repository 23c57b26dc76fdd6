#include "slam/plan/WallClutter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "base/PointIndex.h"
#include "base/Segments.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr double kShortestCluster = 0.8;  // m
constexpr double kTouch = 0.12;           // m

double distance(const TPoint2D& p, const PlanWall& wall) {
  return (p - nearestOnSegment(p, wall.start, wall.end)).norm();
}

/// Sets of walls that touch.
class Clusters {
 public:
  explicit Clusters(size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), size_t{0}); }
  size_t of(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(size_t a, size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<size_t> parent_;
};

}  // namespace

void removeClutter(std::vector<PlanWall>& walls) {
  PointIndex index(kTouch);
  for (size_t i = 0; i < walls.size(); ++i) index.add(walls[i].start, walls[i].end, static_cast<int>(i));
  Clusters clusters(walls.size());
  for (size_t i = 0; i < walls.size(); ++i)
    for (const TPoint2D& end : {walls[i].start, walls[i].end})
      index.near(end, [&](int other) {
        const auto j = static_cast<size_t>(other);
        if (clusters.of(i) != clusters.of(j) && distance(end, walls[j]) < kTouch) clusters.join(i, j);
      });
  std::vector<double> length(walls.size(), 0);
  for (size_t i = 0; i < walls.size(); ++i) length[clusters.of(i)] += walls[i].length();
  std::vector<PlanWall> kept;
  for (size_t i = 0; i < walls.size(); ++i)
    if (length[clusters.of(i)] >= kShortestCluster) kept.push_back(walls[i]);
  walls = std::move(kept);
}

}  // namespace hybrid_slam
