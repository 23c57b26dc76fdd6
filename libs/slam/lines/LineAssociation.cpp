#include "slam/lines/LineAssociation.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;

void AssociationOptions::describe(OptionTable& table) {
  table.add("max_rho", maxRho, 0, 10, "m", "largest distance between segments of one wall");
  table.addAngle("max_theta_deg", maxTheta, 0, 45, "largest angle between segments of one wall");
  table.add("theta_weight", thetaWeight, 0, 1000, "m/rad",
            "weight of theta in the association distance: metres of rho per radian");
  table.add("min_overlap", minOverlap, -100, 100, "m",
            "minimum overlap of two segments of one line; negative: the largest gap between them");
}

LineDifference difference(const LineSegment& segment, const LineSegment& reference) {
  LineDifference result;
  result.theta = halfTurnDifference(segment.theta, reference.theta);
  result.rho = signedDistance(middle(segment), reference.rho, reference.theta);

  const double alongX = -std::sin(reference.theta), alongY = std::cos(reference.theta);
  const auto along = [&](const TPoint2D& p) { return p.x * alongX + p.y * alongY; };
  const auto [low, high] = std::minmax({along(segment.start), along(segment.end)});
  const auto [referenceLow, referenceHigh] = std::minmax({along(reference.start), along(reference.end)});
  result.overlap = std::min(high, referenceHigh) - std::max(low, referenceLow);
  return result;
}

// Sec. III-C, step 1 (search): the weighted Euclidean distance in Hough space of the paper's [13].
std::optional<double> matchDistance(const LineSegment& segment, const LineSegment& reference,
                                    const AssociationOptions& options) {
  // Most lines of a database have another direction: the cheap test first.
  if (std::abs(halfTurnDifference(segment.theta, reference.theta)) > options.maxTheta) return std::nullopt;
  const LineDifference d = difference(segment, reference);
  if (std::abs(d.rho) > options.maxRho || d.overlap < options.minOverlap) return std::nullopt;
  return std::hypot(d.rho, options.thetaWeight * d.theta);
}

}  // namespace hybrid_slam
