/// @file PlanLine.h
/// @brief A straight piece of a floor plan.
#pragma once

#include <mrpt/math/TPoint2D.h>

namespace hybrid_slam {

/// A wall without thickness.
struct PlanLine {
  mrpt::math::TPoint2D start, end;  ///< m, frame of the plan
};

}  // namespace hybrid_slam
