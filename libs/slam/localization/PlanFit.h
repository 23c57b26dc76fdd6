/// @file PlanFit.h
/// @brief Fits pose and scale of a floor plan to scan points.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

#include "slam/plan/PlanLine.h"

namespace hybrid_slam {

struct PlanFit {
  mrpt::math::TPose2D pose;  ///< of the points' frame in the scaled plan (m, rad)
  double scale = 1;          ///< by which the coordinates of the plan are multiplied
};

/// The pose and the scale at which the points lie on the walls: maximum a posteriori by Gauss-Newton from a
/// pose that is right within 0.5 m, with a robust kernel, because furniture is not in the plan. A priori the
/// scale is 1 +- 0.02. Points count by the area they cover, not by their number, because points on one wall
/// share its error.
/// @param points  m, in their own frame
/// @param walls   not empty
/// @return `first` if the fit leaves it by over 1 m or stretches the plan by over 10 %
PlanFit fitPlan(const std::vector<mrpt::math::TPoint2D>& points, const std::vector<PlanLine>& walls,
                const PlanFit& first);

}  // namespace hybrid_slam
