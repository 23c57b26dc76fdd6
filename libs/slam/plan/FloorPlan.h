/// @file FloorPlan.h
/// @brief A particle's map as a floor plan: its lines, confirmed and limited by its grid.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"
#include "slam/lines/LineDatabase.h"
#include "slam/plan/LineEstimate.h"

namespace hybrid_slam {

/// One straight face of a wall. The free side is on the left of start -> end.
struct PlanWall {
  mrpt::math::TPoint2D start, end;  ///< m, map frame
  LineEstimate line;                ///< through them; the covariance excludes the drift of the map
  int count = 0;                    ///< observations of its database lines; 0: from the grid only
  bool isSnapped = false;           ///< parallel or perpendicular to one of the plan's directions
  int group = -1;                   ///< walls of one line (a wall with doors) share it
  int pair = -1;                    ///< index of the wall's other face; -1: not seen
  double thickness = 0;             ///< m between the two faces; 0: the other was not seen

  double length() const { return (end - start).norm(); }
  /// Returns the covariance of offset (m) and angle (rad) at the middle of the wall.
  Eigen::Matrix2d covariance() const { return line.covarianceAt((start + end) * 0.5); }
};

/// A gap between two walls of one line through which the grid is free: a door.
struct Opening {
  mrpt::math::TPoint2D start, end;  ///< m, map frame
};

/// Walls and openings, in the map frame.
struct FloorPlan {
  std::vector<PlanWall> walls;
  std::vector<Opening> openings;
  std::vector<double> directions;  ///< rad in [-pi/4, pi/4]: of the building's wings, modulo 90 deg
};

/// Makes the floor plan of a map. It is empty without occupied cells.
FloorPlan floorPlanOf(const std::vector<DatabaseLine>& lines, const OccupancyGrid& grid);

}  // namespace hybrid_slam
