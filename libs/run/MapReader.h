/// @file MapReader.h
/// @brief Reads the maps of hybrid-slam and of other programs.
#pragma once

#include <string>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam::run {

/// Reads a map of ROS's map_server (`map.yaml` and its picture, see readRosMap) or of MRPT (`map.gridmap`,
/// `.gridmap.gz`); the content counts, not the name. The grid has the resolution of the file (m per cell).
/// MRPT's maps keep their cells; a map of ROS is shifted by up to half a cell if its origin is not a multiple
/// of the resolution.
/// @throws InputError for a file that is not a map, cut off, damaged or too large
OccupancyGrid readMap(const std::string& file);

}  // namespace hybrid_slam::run
