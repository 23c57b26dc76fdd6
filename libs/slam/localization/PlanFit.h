/// @file PlanFit.h
/// @brief Fits pose and scale of a floor plan to scan points.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

#include "slam/plan/PlanLine.h"

namespace hybrid_slam {

/// Where points lie in a plan.
struct PlanFit {
  mrpt::math::TPose2D pose;         ///< of the points' frame in the scaled plan (m, rad)
  double scale = 1;                 ///< by which the coordinates of the plan are multiplied
  std::vector<bool> isOnWall = {};  ///< for each of the thinned points: within 0.15 m of a wall

  /// Share of the points on walls.
  double share() const;
};

/// Returns one of the points (m) in each square of 0.25 m.
std::vector<mrpt::math::TPoint2D> thinned(const std::vector<mrpt::math::TPoint2D>& points);

/// Finds the pose and the scale at which the points lie on the walls: maximum a posteriori by Gauss-Newton
/// from a pose within 0.5 m of the true one, with a robust kernel, because furniture is not in the plan. The
/// prior of the scale is 1 +- 0.02. Uses the thinned points: points count by the area they cover, not by
/// their number, because points on one wall share its error.
/// @param points  m, in their own frame
/// @param walls   not empty
/// @return the fit; `first`, with no point on a wall, if the fit is over 1 m away or scales the plan by over
/// 10 %
PlanFit fitPlan(const std::vector<mrpt::math::TPoint2D>& points, const std::vector<PlanLine>& walls,
                const PlanFit& first);

}  // namespace hybrid_slam
