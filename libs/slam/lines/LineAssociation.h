/// @file LineAssociation.h
/// @brief When two segments belong to one line (Sec. III-C): weighted distance in Hough space and overlap,
/// after Choi et al., "A line feature based SLAM with low grade range sensors using geometric constraints
/// and active exploration for mobile robot" (2008).
#pragma once

#include <optional>

#include "base/Options.h"
#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

/// Section [line_association].
struct AssociationOptions : Options {
  double maxRho = 0.3;               ///< m
  double maxTheta = 5 * M_PI / 180;  ///< rad
  double thetaWeight = 3.5;          ///< m per rad
  double minOverlap = 0;             ///< m; negative: a gap of that size

  void describe(OptionTable& table) override;
};

/// The place of one segment relative to another's line.
struct LineDifference {
  double rho = 0;      ///< m, signed distance of the segment's middle from the reference line
  double theta = 0;    ///< rad, in [-pi/2, pi/2]: lines have no direction of travel
  double overlap = 0;  ///< m shared along the reference line; negative: the gap between the two
};

/// rho is counted about the segment's middle, where it does not depend on where the map's origin is; for a
/// middle at the foot of the origin's perpendicular it is the plain difference of the two rho
/// (doc/paper-notes.md). Being relative to the reference line's own normal, it changes neither at the wrap of
/// the angle nor where rho passes through zero.
LineDifference difference(const LineSegment& segment, const LineSegment& reference);

/// The weighted Euclidean distance sqrt(rho^2 + (thetaWeight theta)^2) in m, or nothing where a difference is
/// above its threshold or the overlap below its own.
std::optional<double> matchDistance(const LineSegment& segment, const LineSegment& reference,
                                    const AssociationOptions& options);

}  // namespace hybrid_slam
