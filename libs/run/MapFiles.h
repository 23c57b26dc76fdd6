/// @file MapFiles.h
/// @brief Writes the map for people and other programs.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <string>
#include <vector>

#include "files/OutputFolder.h"
#include "files/Trajectory.h"
#include "run/Verdict.h"
#include "slam/lines/LineDatabase.h"

namespace hybrid_slam::run {

/// `map.png`: the grid, the path (red), the lines (green), the robot at the end (light blue) and
/// circles around doubtful places (orange). At most 2^26 pixels, 2^14 on a side: larger maps are reduced.
void savePicture(const files::OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid,
                 const files::Trajectory& trajectory, const std::vector<DatabaseLine>& lines,
                 const std::vector<DoubtfulPlace>& doubtful = {});

/// `map.pgm` and `map.yaml` for ROS's map_server: 0 occupied, 254 free, 205 unknown.
void saveRosMap(const files::OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid);

/// `map.gridmap.gz`: the serialised COccupancyGridMap2D.
void saveGridMap(const files::OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid);

/// `lines.csv`: rho,theta,length,x_start,y_start,x_end,y_end,count (m, rad; map frame).
void saveLines(const files::OutputFolder& folder, const std::vector<DatabaseLine>& lines);

}  // namespace hybrid_slam::run
