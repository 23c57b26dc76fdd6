#include "lines/LineWeight.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {
namespace {

/// Angle between two lines modulo a right angle, in [0, pi/4] rad.
double angleFromParallelOrPerpendicular(double a, double b) {
  return std::abs(std::remainder(a - b, M_PI / 2));
}

}  // namespace

void LineWeightOptions::describe(OptionTable& table) {
  table.add("method", method,
            {{Method::dominatingDirection, "dominating_direction"}, {Method::paper, "paper"}},
            "graded weight against the dominating direction, or eq. (9) as printed");
  table.addAngle("sigma_deg", sigma, 0.05, 22.5,
                 "dominating_direction: the spread of directions that the weight tells apart");
  table.addAngle("threshold_deg", threshold, 0, 45,
                 "paper: lines this near to parallel or perpendicular match");
  table.add("floor", floor, 1e-6, 1, "", "the least weight, so that one bad scan cannot end a particle");
}

LineWeight lineWeight(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                      const LineWeightOptions& options) {
  LineWeight weight;
  weight.seen = static_cast<int>(seen.size());
  const bool paper = options.method == LineWeightOptions::Method::paper;
  const auto direction = database.dominatingDirection();
  if (paper ? database.lines().empty() : !direction) return weight;

  double matchedLength = 0, totalLength = 0;
  for (const LineSegment& line : seen) {
    const double theta = line.theta + heading;
    totalLength += line.length;
    if (paper) {
      const bool match =
          std::any_of(database.lines().begin(), database.lines().end(), [&](const DatabaseLine& known) {
            return angleFromParallelOrPerpendicular(theta, known.theta) < options.threshold;
          });
      matchedLength += match ? line.length : 0;
      weight.matched += match;
    } else {
      const double d = angleFromParallelOrPerpendicular(theta, *direction) / options.sigma;
      matchedLength += line.length * std::exp(-0.5 * d * d);
      weight.matched += d <= 2;
    }
  }
  if (totalLength > 0) weight.value = std::clamp(matchedLength / totalLength, options.floor, 1.0);
  return weight;
}

}  // namespace hybrid_slam
