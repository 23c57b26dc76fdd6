#include "slam/grid/BeamSelection.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {
namespace {

struct Point {
  double x, y;
};

double squaredDistance(const Point& a, const Point& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// Returns the next point 15 cm away, so that range noise turns the line between the two by only a few
/// degrees, or the last point before an invalid beam.
template <class Step>
size_t awayFrom(size_t i, const LaserScan& scan, const std::vector<Point>& points, Step next) {
  constexpr double kDistance = 0.15;
  size_t there = i;
  for (size_t j = next(i); j < points.size() && scan.beams[j].valid; j = next(j)) {
    there = j;
    if (squaredDistance(points[i], points[j]) >= kDistance * kDistance) break;
  }
  return there;
}

}  // namespace

BeamSelection::BeamSelection(const LaserScans& scans) {
  size_t first = 0;  // index of the laser's first beam
  for (const LaserScan& scan : scans) {
    std::vector<Point> points;
    points.reserve(scan.beams.size());
    for (const Beam& beam : scan.beams)
      points.push_back({beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle)});
    for (size_t i = 0; i < points.size(); ++i) {
      if (!scan.beams[i].valid) continue;
      const size_t before = awayFrom(i, scan, points, [](size_t j) { return j - 1; });
      const size_t after = awayFrom(i, scan, points, [](size_t j) { return j + 1; });
      double direction = std::atan2(points[after].y - points[before].y, points[after].x - points[before].x);
      direction += scan.sensorPose.phi - scans[0].sensorPose.phi;
      while (direction < 0) direction += M_PI;  // a wall has no sense of direction
      while (direction > M_PI) direction -= M_PI;
      const auto group = static_cast<size_t>(direction / M_PI * static_cast<double>(groups_.size()));
      groups_[std::min(group, groups_.size() - 1)].push_back(first + i);
    }
    first += scan.beams.size();
  }
  std::stable_sort(groups_.begin(), groups_.end(),
                   [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

std::vector<size_t> BeamSelection::take(int beams) const {
  size_t left = 0;
  for (const auto& group : groups_) left += group.size();
  if (beams > 0) left = std::min(left, static_cast<size_t>(beams));
  std::vector<size_t> taken;
  taken.reserve(left);
  size_t groupsLeft = groups_.size();
  for (const auto& group : groups_) {
    const size_t share =
        std::min(group.size(), left / groupsLeft--);  // larger groups fill up for smaller ones
    for (size_t i = 0; i < share; ++i) taken.push_back(group[(2 * i + 1) * group.size() / (2 * share)]);
    left -= share;
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

}  // namespace hybrid_slam
