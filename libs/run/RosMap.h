/// @file RosMap.h
/// @brief Reads the maps of ROS's map_server.
#pragma once

#include <string>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam::run {

/// Reads a `map.yaml` and the picture that it names, by the rules of map_server (modes trinary, scale and
/// raw). Occupied cells get an occupancy of 0.97, free ones 0.03; those of `scale` and `raw` are limited to
/// that range. Cells lie at multiples of the resolution: if the origin does not, the map is shifted by at
/// most half a cell.
/// @throws InputError for a file that is not such a map, a rotated map (yaw other than 0), or an unreadable
/// picture
OccupancyGrid readRosMap(const std::string& file);

}  // namespace hybrid_slam::run
