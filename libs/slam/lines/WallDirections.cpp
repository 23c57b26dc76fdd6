#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

std::optional<double> directionModuloRightAngle(const std::vector<DatabaseLine>& lines) {
  double sine = 0, cosine = 0, total = 0;
  for (const DatabaseLine& line : lines) {
    const double weight = evidence(line);
    sine += weight * std::sin(4 * line.theta);
    cosine += weight * std::cos(4 * line.theta);
    total += weight;
  }
  // Lines at 45 deg to each other cancel: the remainder is rounding error.
  if (std::hypot(sine, cosine) <= 1e-9 * total) return std::nullopt;
  return std::atan2(sine, cosine) / 4;
}

std::optional<double> directionModuloRightAngle(const std::vector<LineSegment>& seen) {
  std::vector<DatabaseLine> lines(seen.size());
  std::transform(seen.begin(), seen.end(), lines.begin(), [](const LineSegment& segment) {
    DatabaseLine line;
    static_cast<LineSegment&>(line) = segment;
    return line;
  });
  return directionModuloRightAngle(lines);
}

double wrapToRightAngle(double angle) { return std::remainder(angle, M_PI / 2); }

namespace {

/// Moments of weighted directions, relative to a direction that moves.
struct Moments {
  double m0 = 0, m1 = 0, m2 = 0, m3 = 0;

  void add(double weight, double d) {
    m0 += weight;
    m1 += weight * d;
    m2 += weight * d * d;
    m3 += weight * d * d * d;
  }
  void moveBy(double d) {
    m3 -= d * (3 * m2 - d * (3 * m1 - d * m0));
    m2 -= d * (2 * m1 - d * m0);
    m1 -= d * m0;
  }
};

}  // namespace

// A window slides over the sorted directions. The sums over it follow from its moments, so the time does not
// grow with the number of parallel lines, which in a large building are nearly all.
void setDirections(std::vector<DatabaseLine>& lines, double window) {
  struct Known {
    double theta, evidence;
    DatabaseLine* line;
  };
  const size_t n = lines.size();
  std::vector<Known> sorted;
  sorted.reserve(n);
  for (DatabaseLine& line : lines) sorted.push_back({wrapToRightAngle(line.theta), evidence(line), &line});
  std::sort(sorted.begin(), sorted.end(), [](const Known& a, const Known& b) { return a.theta < b.theta; });

  // Of the n lines repeated every 90 deg: k in [n, 2 n) are the lines themselves.
  const auto theta = [&](size_t k) {
    const size_t turns = k / n;
    return sorted[k % n].theta + (static_cast<double>(turns) - 1) * M_PI / 2;
  };
  Moments moments;
  size_t low = 0, high = 0;  // the window: low <= k < high
  double last = 0;
  for (size_t i = n; i < 2 * n; ++i) {
    const double centre = theta(i);
    moments.moveBy(centre - last);
    last = centre;
    for (; low < high && theta(low) <= centre - window; ++low)
      moments.add(-sorted[low % n].evidence, theta(low) - centre);
    if (low == high) {  // without the rounding errors of what left
      moments = {};
      while (theta(low) <= centre - window) ++low;
      high = low;
    }
    for (; high < 3 * n && theta(high) < centre + window; ++high)
      moments.add(sorted[high % n].evidence, theta(high) - centre);
    const double square = window * window, total = square * moments.m0 - moments.m2;
    const double offset = total > 0 ? (square * moments.m1 - moments.m3) / total : 0;
    sorted[i % n].line->direction = wrapToRightAngle(centre + offset);
  }
}

std::vector<double> alignedHeadings(const std::vector<LineSegment>& seen, const LineDatabase& map) {
  const auto scan = directionModuloRightAngle(seen), walls = map.dominatingDirection();
  if (!scan || !walls) return {};
  return {*walls - *scan, *walls - *scan + M_PI / 2, *walls - *scan + M_PI, *walls - *scan - M_PI / 2};
}

}  // namespace hybrid_slam
