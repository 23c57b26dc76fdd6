#include "slam/lines/LineDatabase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;

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

}  // namespace hybrid_slam
