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

/// Writes `map.png` (`mapPicture`).
void savePicture(const files::OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid,
                 const files::Trajectory& trajectory, const std::vector<DatabaseLine>& lines,
                 const std::vector<DoubtfulPlace>& doubtful = {});

/// Writes `map.pgm` and `map.yaml` for ROS's map_server (`MapRaster`).
void saveRosMap(const files::OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid,
                const files::Trajectory& trajectory);

/// Writes `map.gridmap.gz`, the serialised COccupancyGridMap2D.
void saveGridMap(const files::OutputFolder& folder, const mrpt::maps::COccupancyGridMap2D& grid);

/// Writes `lines.csv`: rho,theta,length,x_start,y_start,x_end,y_end,count (m, rad; map frame).
void saveLines(const files::OutputFolder& folder, const std::vector<DatabaseLine>& lines);

}  // namespace hybrid_slam::run
