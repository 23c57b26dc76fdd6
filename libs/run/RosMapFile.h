/// @file RosMapFile.h
/// @brief The map.yaml of ROS's map_server.
#pragma once

#include <string>

namespace hybrid_slam::run {

/// How map_server reads grey values: as three states, as probabilities, or as the cells' values themselves.
enum class RosMapMode { trinary, scale, raw };

/// Contents of a map.yaml.
struct RosMapFile {
  std::string picture;  ///< path
  double resolution;    ///< m per pixel, 0.001 .. 10
  double x, y;          ///< m; lower left corner of the lower left pixel, at most 2^20 pixels from (0, 0)
  bool isNegated;       ///< white is occupied
  double occupiedAbove, freeBelow;  ///< occupancies, 0 .. 1
  RosMapMode mode;
};

/// Reads a map.yaml.
/// @throws InputError for any other file, a wrong value, or a rotated map (yaw other than 0)
RosMapFile readRosMapFile(const std::string& file);

}  // namespace hybrid_slam::run
