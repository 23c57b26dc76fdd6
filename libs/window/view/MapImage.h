/// @file MapImage.h
/// @brief The known part of an occupancy grid as a grey image, with its position in the map frame.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hybrid_slam::window {

/// Grey values row by row, from the largest y, as on screens.
struct MapImage {
  int width = 0, height = 0;    ///< pixels
  double resolution = 0;        ///< m, of a pixel
  double left = 0, bottom = 0;  ///< m, map frame: outer edges of the picture
  std::vector<uint8_t> grey;    ///< 0 occupied, 255 free, about 127 unknown

  double right() const { return left + width * resolution; }
  double top() const { return bottom + height * resolution; }
};

/// Describes a place of the map: "x 1.25 m, y -3.00 m: occupied 0.98". The value is the probability that the
/// cell is occupied; "unknown" for cells that no beam has reached, and outside the map.
/// @param x,y  m, map frame
std::string describeCell(const MapImage& map, double x, double y);

/// Returns the known cells with a margin of 10 cells; an empty picture if there are none. A pixel is a cell,
/// or the most occupied of n x n cells, with the smallest n for at most 8192 pixels per side, which graphics
/// cards can show.
MapImage mapImage(const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace hybrid_slam::window
