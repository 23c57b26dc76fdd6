/// @file WallClutter.h
/// @brief Distinguishes walls from chair legs and single echoes.
#pragma once

#include <vector>

#include "slam/plan/FloorPlan.h"

namespace hybrid_slam {

/// Removes walls that, with all walls that they touch, are shorter than 0.8 m.
void removeClutter(std::vector<PlanWall>& walls);

}  // namespace hybrid_slam
