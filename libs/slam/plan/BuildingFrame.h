/// @file BuildingFrame.h
/// @brief The directions of a building's walls.
#pragma once

#include <vector>

#include "slam/plan/WallLines.h"

namespace hybrid_slam {

/// A direction modulo 90 deg that many walls share.
struct BuildingDirection {
  double angle = 0;     ///< rad in [-pi/4, pi/4]
  double variance = 0;  ///< rad^2, of the mean
};

/// Finds the directions, modulo 90 deg, that each have at least 6 % of the walls' length and 5 m; the longest
/// first.
std::vector<BuildingDirection> buildingDirections(const std::vector<WallLine>& lines);

/// Turns a line to a direction or its perpendicular if both agree within three standard deviations.
/// @return whether it was turned
bool snapTo(const std::vector<BuildingDirection>& directions, LineEstimate& line);

}  // namespace hybrid_slam
