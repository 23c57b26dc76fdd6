#include "slam/lines/LineAssociation.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;

void AssociationOptions::describe(OptionTable& table) {
  table.add("max_rho", maxRho, 0, 10, "m", "lines further apart than this are different walls");
  table.addAngle("max_theta_deg", maxTheta, 0, 45, "lines that differ by more than this are different walls");
  table.add("theta_weight", thetaWeight, 0, 1000, "m/rad",
            "how much rho a radian of theta is worth in the distance");
  table.add("min_overlap", minOverlap, -100, 100, "m",
            "length that two segments of one line share; negative: the gap that may lie between them");
}

LineDifference difference(const LineSegment& segment, const LineSegment& reference) {
  LineDifference result;
  result.theta = std::remainder(segment.theta - reference.theta, M_PI);
  result.rho = signedDistance(middle(segment), reference.rho, reference.theta);

  const double alongX = -std::sin(reference.theta), alongY = std::cos(reference.theta);
  const auto along = [&](const TPoint2D& p) { return p.x * alongX + p.y * alongY; };
  const auto [low, high] = std::minmax({along(segment.start), along(segment.end)});
  const auto [referenceLow, referenceHigh] = std::minmax({along(reference.start), along(reference.end)});
  result.overlap = std::min(high, referenceHigh) - std::max(low, referenceLow);
  return result;
}

std::optional<double> matchDistance(const LineSegment& segment, const LineSegment& reference,
                                    const AssociationOptions& options) {
  const LineDifference d = difference(segment, reference);
  if (std::abs(d.rho) > options.maxRho || std::abs(d.theta) > options.maxTheta ||
      d.overlap < options.minOverlap)
    return std::nullopt;
  return std::hypot(d.rho, options.thetaWeight * d.theta);
}

}  // namespace hybrid_slam
