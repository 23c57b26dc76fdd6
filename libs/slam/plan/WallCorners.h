/// @file WallCorners.h
/// @brief Corners of a floor plan: walls that end near each other end at one point.
#pragma once

#include <vector>

#include "slam/plan/FloorPlan.h"
#include "slam/plan/GridProbe.h"

namespace hybrid_slam {

/// Moves the ends of walls to the intersection with another wall's line (L and T), if this is near and the
/// grid is not free in between.
void closeCorners(std::vector<PlanWall>& walls, const GridProbe& probe);

}  // namespace hybrid_slam
