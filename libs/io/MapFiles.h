/// @file MapFiles.h
/// @brief The map in the forms that people and other programs take.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <string>
#include <vector>

#include "evaluation/Trajectory.h"
#include "io/OutputFolder.h"
#include "lines/LineDatabase.h"

namespace hybrid_slam {

/// `map.png`: the grid, the path (red), the lines (green) and the robot at the end (light blue).
void savePicture(const OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid,
                 const Trajectory& trajectory, const std::vector<DatabaseLine>& lines);

/// `map.pgm` and `map.yaml` as ROS's map_server takes them: 0 occupied, 254 free, 205 unknown.
void saveRosMap(const OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid);

/// `map.gridmap.gz`: the serialised COccupancyGridMap2D.
void saveGridMap(const OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid);

/// `lines.csv`: rho,theta,length,x_start,y_start,x_end,y_end,count (m, rad; map frame).
void saveLines(const OutputFolder& folder, const std::vector<DatabaseLine>& lines);

}  // namespace hybrid_slam
