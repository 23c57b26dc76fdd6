/// @file FloorPlanFile.h
/// @brief Parses floor plan files (doc/simulation.md).
#pragma once

#include <string>
#include <vector>

#include "study/simulation/Wall.h"

namespace hybrid_slam::simulation {

/// Walls in file order, doors already cut out.
/// @throws InputError as BuildingPlan::load
std::vector<Wall> readWalls(const std::string& file);

}  // namespace hybrid_slam::simulation
