#include "slam/lines/LineWeight.h"

#include <mrpt/math/TSegment2D.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/lines/DirectionFrames.h"
#include "slam/lines/WallDirections.h"

namespace hybrid_slam {
namespace {

using Method = LineWeightOptions::Method;

bool hasDirections(const LineDatabase& database, Method method) {
  return method == Method::dominatingDirection ? database.dominatingDirection().has_value()
                                               : !database.lines().empty();
}

}  // namespace

void LineWeightOptions::describe(OptionTable& table) {
  table.add("method", method,
            {{Method::frames, "frames"},
             {Method::graded, "graded"},
             {Method::dominatingDirection, "dominating_direction"},
             {Method::paper, "paper"}},
            "paper: eq. (9) as printed; graded: eq. (9) with a smooth match; frames: a smooth match to the "
            "directions that several lines share; dominating_direction: to the dominating direction only");
  table.addAngle("sigma_deg", sigma, 0.05, 22.5,
                 "graded, frames, dominating_direction: standard deviation of a direction");
  table.addAngle("threshold_deg", threshold, 0, 45,
                 "paper: largest deviation from parallel or perpendicular for a match");
  table.add("floor", floor, 1e-6, 1, "", "minimum weight, so that one bad scan cannot kill a particle");
  table.add("radius", radius, 0, 1000, "m",
            "largest distance from the robot of a database line that is compared; 0: no limit");
}

LineDatabase linesNear(const LineDatabase& database, const mrpt::math::TPoint2D& robot, double radius) {
  if (radius <= 0) return database;
  std::vector<DatabaseLine> near;
  for (const DatabaseLine& line : database.lines())
    if (mrpt::math::TSegment2D(line.start, line.end).distance(robot) <= radius) near.push_back(line);
  return LineDatabase(std::move(near));
}

std::shared_ptr<const LineDatabase> comparedLines(const LineDatabase& database,
                                                  const mrpt::math::TPoint2D& robot,
                                                  const LineWeightOptions& options) {
  if (options.method != Method::frames && options.radius <= 0)
    return {std::shared_ptr<void>(), &database};  // not owned
  LineDatabase near = linesNear(database, robot, options.radius);
  if (options.method != Method::frames) return std::make_shared<LineDatabase>(std::move(near));
  std::vector<DatabaseLine> lines;
  for (const DirectionFrame& frame : directionFrames(near.lines())) {
    DatabaseLine line;
    line.theta = line.direction = frame.direction;
    line.length = frame.evidence;  // observed once, so this is its evidence
    lines.push_back(line);
  }
  return std::make_shared<LineDatabase>(std::move(lines));
}

DirectionMatch matchDirection(double theta, const LineDatabase& database, const LineWeightOptions& options) {
  const double wrapped = wrapToRightAngle(theta), information = 1 / (options.sigma * options.sigma);
  DirectionMatch match;
  const auto add = [&](double direction, double weight) {
    constexpr double kLeastExponent = -20;  // exp(-20) = 2e-9
    const double d = rightAngleDifference(wrapped, direction), exponent = -0.5 * d * d * information;
    match.isMatched |= std::abs(d) <= 2 * options.sigma;
    if (exponent < kLeastExponent) return;
    const double agreement = weight * std::exp(exponent);
    match.value += agreement;
    match.slope -= agreement * d * information;
  };
  switch (options.method) {
    case Method::frames:
    case Method::graded: {
      const double total = database.totalEvidence();
      if (total <= 0) break;
      for (const DatabaseLine& line : database.lines()) add(line.direction, evidence(line) / total);
      break;
    }
    case Method::dominatingDirection:
      if (const auto direction = database.dominatingDirection()) add(*direction, 1);
      break;
    case Method::paper:
      for (const DatabaseLine& line : database.lines())
        if (std::abs(rightAngleDifference(wrapped, wrapToRightAngle(line.theta))) < options.threshold) {
          match.value = 1;
          match.isMatched = true;
          break;
        }
      break;
  }
  return match;
}

// eq. (9), Sec. III-D.
LineWeight lineWeight(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                      const LineWeightOptions& options) {
  LineWeight weight;
  weight.seen = static_cast<int>(seen.size());
  if (!hasDirections(database, options.method)) return weight;

  double matchedLength = 0, slope = 0, totalLength = 0;
  for (const LineSegment& line : seen) {
    const DirectionMatch match = matchDirection(line.theta + heading, database, options);
    totalLength += line.length;
    matchedLength += line.length * match.value;
    slope += line.length * match.slope;
    weight.matched += match.isMatched;
  }
  if (totalLength <= 0) return weight;
  weight.value = matchedLength / totalLength;
  weight.slope = slope / totalLength;
  if (weight.value <= options.floor) {
    weight.value = options.floor;
    weight.slope = 0;
  }
  weight.value = std::min(weight.value, 1.0);  // rounding
  return weight;
}

}  // namespace hybrid_slam
