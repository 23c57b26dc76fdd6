/// @file WallHeadings.h
/// @brief Headings of the robot, measured by the directions of the walls that it sees.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

#include "slam/lines/LineSegment.h"
#include "slam/loops/PoseGraph.h"

namespace hybrid_slam {

/// Returns the direction of the walls in the lines of a scan, modulo 90 deg (rad, robot frame). Empty if they
/// are shorter than 3 m in total.
std::optional<double> wallDirection(const std::vector<LineSegment>& lines);

/// The headings of poses by the walls that they see, as edges from the first pose. Empty if the walls do not
/// share one direction: if their means over stretches of the path vary by more than the noise of the headings
/// explains, some walls are at an angle to the others, as where buildings of a campus are turned.
/// @param poses      map frame
/// @param distances  m, of the poses along the path
/// @param walls      of each pose: direction of the walls modulo 90 deg, rad, robot frame
/// @param direction  of the walls in the map, modulo 90 deg, rad, map frame
std::vector<PoseEdge> wallHeadings(const std::vector<mrpt::math::TPose2D>& poses,
                                   const std::vector<double>& distances,
                                   const std::vector<std::optional<double>>& walls, double direction);

}  // namespace hybrid_slam
