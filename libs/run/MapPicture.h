/// @file MapPicture.h
/// @brief Draws the map for people.
#pragma once

#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "run/MapRaster.h"
#include "run/Verdict.h"
#include "slam/lines/LineDatabase.h"

namespace hybrid_slam::run {

/// Marks that `map.png` shows on the cells.
struct MapMarks {
  const files::Trajectory& trajectory;         ///< red; the robot at its end is light blue
  const std::vector<DatabaseLine>& lines;      ///< green, where the map is not free
  const std::vector<DoubtfulPlace>& doubtful;  ///< orange circles
};

/// Returns the bytes of a PNG: the map in a frame with round coordinates, a scale bar and a legend. Larger
/// maps are reduced to at most 2^26 pixels, 2^14 per side.
std::string mapPicture(const MapRaster& map, const MapMarks& marks);

}  // namespace hybrid_slam::run
