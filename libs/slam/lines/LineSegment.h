/// @file LineSegment.h
/// @brief The line feature of the paper, l = {rho, theta, l, start, end} (Sec. III-B).
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cmath>
#include <vector>

namespace mrpt::math {
struct TPose2D;
}

namespace hybrid_slam {

/// A segment of the line x cos(theta) + y sin(theta) = rho (Hesse normal form, used throughout). theta is the
/// direction of the normal from the frame's origin to the line; a line through the origin (rho = 0) has two,
/// and either is valid.
struct LineSegment {
  double rho = 0;                   ///< m, >= 0
  double theta = 0;                 ///< rad, in (-pi, pi]
  double length = 0;                ///< m
  mrpt::math::TPoint2D start, end;  ///< m, on the line, in the line's frame

  template <class State>
  void visit(State& state) {
    state(rho, theta, length, start, end);
    state.check(rho >= 0 && rho < 1e7 && std::abs(theta) < 4 && length >= 0 && length < 1e7,
                "a line is impossible");
  }
};

/// Computes rho, theta and length from the two ends. Two equal ends give a line parallel to the x axis.
LineSegment makeSegment(const mrpt::math::TPoint2D& start, const mrpt::math::TPoint2D& end);

/// The segment of the line (rho, theta) between the projections of two points.
LineSegment makeSegment(double rho, double theta, const mrpt::math::TPoint2D& start,
                        const mrpt::math::TPoint2D& end);

/// Transforms segments from `frame` to the frame that `frame` is given in (sensor -> robot -> map).
LineSegment transformed(const LineSegment& segment, const mrpt::math::TPose2D& frame);
/// Transforms each segment in the same way.
std::vector<LineSegment> transformed(std::vector<LineSegment> segments, const mrpt::math::TPose2D& frame);

/// Normalises to rho >= 0 and theta in (-pi, pi]: (rho, theta) and (-rho, theta + pi) are the same line.
void normalise(double& rho, double& theta);

/// a - b modulo 180 deg, rad in [-pi/2, pi/2]: std::remainder(a - b, pi), faster for angles within half a
/// turn.
inline double halfTurnDifference(double a, double b) {
  double d = a - b;
  if (d > M_PI / 2)
    d -= M_PI;
  else if (d < -M_PI / 2)
    d += M_PI;
  return std::abs(d) <= M_PI / 2 ? d : std::remainder(d, M_PI);
}

/// Signed distance (m) of a point from the line, positive on the side of the normal.
double signedDistance(const mrpt::math::TPoint2D& point, double rho, double theta);

/// Projection of a point onto the line.
mrpt::math::TPoint2D projected(const mrpt::math::TPoint2D& point, double rho, double theta);

/// Midpoint of the segment.
mrpt::math::TPoint2D middle(const LineSegment& segment);

}  // namespace hybrid_slam
