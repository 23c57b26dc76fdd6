/// @file LineSegment.h
/// @brief The line feature of the paper, l = {rho, theta, l, start, end} (Sec. III-B).
#pragma once

#include <mrpt/math/TPoint2D.h>

namespace mrpt::math {
struct TPose2D;
}

namespace hybrid_slam {

/// A piece of the line x cos(theta) + y sin(theta) = rho: Hesse normal form, the one convention of the
/// project. theta is the direction of the normal that points from the frame's origin to the line; a line
/// through the origin (rho = 0) has two such normals and either may stand here.
struct LineSegment {
  double rho = 0;                   ///< m, >= 0
  double theta = 0;                 ///< rad, in (-pi, pi]
  double length = 0;                ///< m
  mrpt::math::TPoint2D start, end;  ///< m, on the line, in the frame that the line is expressed in
};

/// rho, theta and length from the two ends. Two equal ends have no direction: theta is then that of the
/// line parallel to the x axis.
LineSegment makeSegment(const mrpt::math::TPoint2D& start, const mrpt::math::TPoint2D& end);

/// The piece of the line (rho, theta) between the projections of two points on it.
LineSegment makeSegment(double rho, double theta, const mrpt::math::TPoint2D& start,
                        const mrpt::math::TPoint2D& end);

/// The segment, given in `frame`, seen from the frame in which `frame` is given (sensor -> robot -> map).
LineSegment transformed(const LineSegment& segment, const mrpt::math::TPose2D& frame);

/// Brings (rho, theta) to rho >= 0 and theta in (-pi, pi]: (rho, theta) and (-rho, theta + pi) are one line.
void normalise(double& rho, double& theta);

/// Signed distance (m) of a point from the line, positive on the side that the normal points to.
double signedDistance(const mrpt::math::TPoint2D& point, double rho, double theta);

/// The foot of a point's perpendicular on the line.
mrpt::math::TPoint2D projected(const mrpt::math::TPoint2D& point, double rho, double theta);

/// The point half way between the ends.
mrpt::math::TPoint2D middle(const LineSegment& segment);

}  // namespace hybrid_slam
