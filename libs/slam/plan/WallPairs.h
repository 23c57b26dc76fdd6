/// @file WallPairs.h
/// @brief Pairs the two faces of each wall.
#pragma once

#include <vector>

#include "slam/plan/FloorPlan.h"
#include "slam/plan/GridProbe.h"

namespace hybrid_slam {

/// Sets `pair` and `thickness` of faces that are parallel, at most 0.4 m apart, overlap by half of the
/// shorter one's length and have no free cells between them.
void pairFaces(std::vector<PlanWall>& walls, const GridProbe& probe);

}  // namespace hybrid_slam
