/// @file FloorPlanFile.h
/// @brief Floor plans as text: the words of doc/simulation.md into walls.
#pragma once

#include <string>
#include <vector>

#include "study/simulation/Wall.h"

namespace hybrid_slam::simulation {

/// Walls in file order, doors already cut out.
/// @throws InputError as FloorPlan::load
std::vector<Wall> readWalls(const std::string& file);

}  // namespace hybrid_slam::simulation
