/// @file MapReader.h
/// @brief Reads the maps of hybrid-slam and of other programs.
#pragma once

#include <string>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam::run {

/// The map of a ROS map_server pair (`map.yaml` and its picture, see readRosMap) or of MRPT (`map.gridmap`,
/// `.gridmap.gz`); the content counts, not the name. The resolution of the grid is that of the file (m per
/// cell). A map of MRPT keeps its cells; one of ROS is shifted by up to half a cell if its origin is not at a
/// multiple of the resolution.
/// @throws InputError for a file that is no map, cut off, damaged or too large
OccupancyGrid readMap(const std::string& file);

}  // namespace hybrid_slam::run
