/// @file Wall.h
/// @brief One wall of a floor plan: a straight segment or an arc of a circle.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <limits>

namespace hybrid_slam::simulation {

/// A wall without thickness, in the frame of the floor plan (m, rad).
struct Wall {
  mrpt::math::TPoint2D start, end;  ///< also for an arc
  mrpt::math::TPoint2D centre;      ///< arc only
  double radius = 0;                ///< m; 0 for a straight wall
  double startAngle = 0;            ///< rad; arc only
  double sweep = 0;                 ///< rad in (0, 2 pi], counter-clockwise from startAngle; arc only

  static Wall straight(const mrpt::math::TPoint2D& start, const mrpt::math::TPoint2D& end);
  static Wall arc(const mrpt::math::TPoint2D& centre, double radius, double startAngle, double sweep);

  bool isArc() const { return radius > 0; }
  double length() const;                                 ///< m
  mrpt::math::TPoint2D pointAt(double fraction) const;   ///< 0: start, 1: end
  double distance(const mrpt::math::TPoint2D& p) const;  ///< m, from p to the nearest point of the wall
};

/// Distance (m) for a ray that hits no wall.
constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Distance (m, >= 0) from `origin` along the unit vector `direction` to the wall; kNoHit for a miss. A ray
/// along a straight wall hits its nearer end.
double rayDistance(const Wall& wall, const mrpt::math::TPoint2D& origin,
                   const mrpt::math::TPoint2D& direction);

}  // namespace hybrid_slam::simulation
