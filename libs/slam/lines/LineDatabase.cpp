#include "slam/lines/LineDatabase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hybrid_slam {

using mrpt::math::TPoint2D;

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

void LineDatabaseOptions::describe(OptionTable& table) {
  table.add("min_length", minLength, 0, 100, "m", "minimum length of a new line");
  table.add("min_count", minCount, 1, 1000,
            "minimum number of observations of a line; others are pruned, as most come from sensor or "
            "localisation errors");
  table.add("prune_interval", pruneInterval, 1, 10000,
            "updates between prunings, and grace period of a new line");
  table.addAngle("direction_window_deg", directionWindow, 0, 22.5,
                 "largest difference, modulo 90 deg, between the directions of lines that share one "
                 "dominating direction");
}

DatabaseLine merged(const DatabaseLine& line, const LineSegment& seen, int observations) {
  const double n = line.count, m = observations;
  const auto mean = [n, m](double old, double now) { return (n * old + m * now) / (n + m); };  // eq. (7), (8)
  const TPoint2D oldMiddle = middle(line), newMiddle = middle(seen);
  const TPoint2D pivot(mean(oldMiddle.x, newMiddle.x), mean(oldMiddle.y, newMiddle.y));

  // The observed line in the representation, (rho, theta) or (-rho, theta + pi), whose normal agrees with the
  // old line's.
  const double turn = std::remainder(seen.theta - line.theta, M_PI);
  const bool flipped = std::cos(seen.theta - line.theta) < 0;
  const double seenRho = flipped ? -seen.rho : seen.rho, seenTheta = line.theta + turn;

  // eq. (7), about the pivot: signedDistance is minus rho from there.
  const double rho =
      -mean(signedDistance(pivot, line.rho, line.theta), signedDistance(pivot, seenRho, seenTheta));
  const double theta = mean(line.theta, seenTheta);  // eq. (8)

  // Fig. 2: the two farthest of the four ends.
  const std::array<TPoint2D, 4> ends{line.start, line.end, seen.start, seen.end};
  TPoint2D start, end;
  double longest = -1;
  for (size_t i = 0; i < ends.size(); ++i)
    for (size_t j = i + 1; j < ends.size(); ++j) {
      const double length = std::hypot(ends[j].x - ends[i].x, ends[j].y - ends[i].y);
      if (length > longest) {
        longest = length;
        start = ends[i];
        end = ends[j];
      }
    }

  DatabaseLine result = line;
  static_cast<LineSegment&>(result) = makeSegment(rho + signedDistance(pivot, 0, theta), theta, start, end);
  result.count += observations;
  return result;
}

LineDatabase::LineDatabase(std::vector<DatabaseLine> lines) : lines_(std::move(lines)) {
  for (DatabaseLine& line : lines_) line.inserted = 0;
  sum();
}

void LineDatabase::sum() {
  dominatingDirection_ = directionModuloRightAngle(lines_);
  totalEvidence_ = 0;
  for (const DatabaseLine& line : lines_) totalEvidence_ += evidence(line);
}

void LineDatabase::update(const std::vector<LineSegment>& seen, const LineDatabaseOptions& options,
                          const AssociationOptions& association) {
  ++updates_;
  for (const LineSegment& line : seen) {
    if (const DatabaseLine* match = closestMatch(line, association))
      lines_[static_cast<size_t>(match - lines_.data())] = merged(*match, line);
    else if (line.length >= options.minLength)
      lines_.push_back({line, 1, updates_, 0});
  }
  if (updates_ % options.pruneInterval == 0) prune(options);
  sum();
  setDirections(lines_, options.directionWindow);
}

const DatabaseLine* LineDatabase::closestMatch(const LineSegment& seen,
                                               const AssociationOptions& association) const {
  const DatabaseLine* closest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const DatabaseLine& line : lines_) {
    const auto distance = matchDistance(seen, line, association);
    if (distance && *distance < least) {
      least = *distance;
      closest = &line;
    }
  }
  return closest;
}

void LineDatabase::prune(const LineDatabaseOptions& options) {
  const auto hopeless = [&](const DatabaseLine& line) {
    return line.count < options.minCount && updates_ - line.inserted >= options.pruneInterval;
  };
  lines_.erase(std::remove_if(lines_.begin(), lines_.end(), hopeless), lines_.end());
}

std::vector<double> alignedHeadings(const std::vector<LineSegment>& seen, const LineDatabase& map) {
  const auto scan = directionModuloRightAngle(seen), walls = map.dominatingDirection();
  if (!scan || !walls) return {};
  return {*walls - *scan, *walls - *scan + M_PI / 2, *walls - *scan + M_PI, *walls - *scan - M_PI / 2};
}

}  // namespace hybrid_slam
