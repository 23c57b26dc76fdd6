/// @file PlanPlots.h
/// @brief Plots in the floor plan's frame (m): trajectories, and a map's cells over the walls (Fig. 6).
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "study/comparison/Gnuplot.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::comparison {

/// The commands for the block `$walls`, to be drawn with lines.
std::string wallBlock(const simulation::BuildingPlan& plan);

/// The commands for a plot with axes x and y of the same scale.
std::string planFrame(const std::string& title, const mrpt::math::TPoint2D& low,
                      const mrpt::math::TPoint2D& high);

/// All trajectories of a group, over the reference and the floor plan's walls. At most 4,000 points of them
/// are drawn, equally spaced.
/// @param colour  0xRRGGBB; @param plan  may be null; @param reference  may be empty
Plot plotTrajectories(const std::string& group, int colour,
                      const std::vector<files::Trajectory>& trajectories, const files::Trajectory& reference,
                      const simulation::BuildingPlan* plan);

/// The paper's Fig. 6: a map's occupied cells over the walls, coloured by their distance to the nearest wall;
/// cells more than 2 m outside of the plan are left out. The picture has at most 480 pixels a side, each with
/// the colour of its worst cell.
/// @param cells       m, centres in the plan's frame
/// @param resolution  m, side of a cell
Plot plotCellsOverWalls(const std::vector<mrpt::math::TPoint2D>& cells, double resolution,
                        const simulation::BuildingPlan& plan, const std::string& title);

}  // namespace hybrid_slam::comparison
