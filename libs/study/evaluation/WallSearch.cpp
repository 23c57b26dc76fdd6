#include "study/evaluation/WallSearch.h"

#include <algorithm>

#include "base/Segments.h"

namespace hybrid_slam::evaluation {

using mrpt::math::TPoint2D;

std::vector<WallPoint> pointsOn(const std::vector<PlanLine>& walls, double step) {
  std::vector<WallPoint> points;
  double next = step / 2;  // m along the wall
  for (const PlanLine& wall : walls) {
    const TPoint2D d = wall.end - wall.start;
    const double length = d.norm();
    for (; next < length; next += step)
      points.push_back({wall.start + d * (next / length), std::atan2(d.y, d.x)});
    next -= length;
  }
  return points;
}

WallSearch::WallSearch(const std::vector<PlanLine>& walls, const AgreementOptions& options)
    : walls_(walls), options_(options), index_(options.distance) {
  for (size_t i = 0; i < walls.size(); ++i) index_.add(walls[i].start, walls[i].end, static_cast<int>(i));
}

std::optional<WallSearch::Found> WallSearch::nearest(const WallPoint& point) const {
  std::optional<Found> best;
  index_.near(point.at, [&](int i) {
    const PlanLine& wall = walls_[static_cast<size_t>(i)];
    const TPoint2D d = wall.end - wall.start;
    const double angle = std::abs(std::remainder(std::atan2(d.y, d.x) - point.angle, M_PI));
    if (angle > options_.angle) return;
    const TPoint2D nearest = nearestOnSegment(point.at, wall.start, wall.end);
    const double offset = (point.at - nearest).norm();
    if (offset <= options_.distance && (!best || offset < best->offset)) best = Found{offset, angle, nearest};
  });
  return best;
}

}  // namespace hybrid_slam::evaluation
