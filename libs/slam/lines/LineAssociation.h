/// @file LineAssociation.h
/// @brief Line association (Sec. III-C): weighted distance in Hough space and overlap, after Choi et al., "A
/// line feature based SLAM with low grade range sensors using geometric constraints and active exploration
/// for mobile robot" (2008).
#pragma once

#include <mrpt/core/bits_math.h>

#include <optional>

#include "base/Options.h"
#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

/// Section [line_association].
struct AssociationOptions : Options {
  double maxRho = 0.3;                   ///< m
  double maxTheta = mrpt::DEG2RAD(5.0);  ///< rad
  double thetaWeight = 3.5;              ///< m per rad
  double minOverlap = 0;                 ///< m; negative: a gap of this size

  void describe(OptionTable& table) override;
};

/// Position of a segment relative to a reference line.
struct LineDifference {
  double rho = 0;      ///< m, signed distance of the segment's midpoint from the reference line
  double theta = 0;    ///< rad, in [-pi/2, pi/2]: lines are undirected
  double overlap = 0;  ///< m shared along the reference line; negative: the gap between the two
};

/// rho is measured at the segment's midpoint, so it does not depend on the map's origin; if the midpoint is
/// the foot of the perpendicular from the origin, it is the difference of the two rho (doc/paper-notes.md).
/// It is measured along the reference line's normal, so it is continuous where the angle wraps and where rho
/// is zero.
LineDifference difference(const LineSegment& segment, const LineSegment& reference);

/// The weighted Euclidean distance sqrt(rho^2 + (thetaWeight theta)^2) in m; empty if a difference exceeds
/// its threshold or the overlap is too small.
std::optional<double> matchDistance(const LineSegment& segment, const LineSegment& reference,
                                    const AssociationOptions& options);

}  // namespace hybrid_slam
