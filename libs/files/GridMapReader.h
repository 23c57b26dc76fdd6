/// @file GridMapReader.h
/// @brief Reads MRPT's grid maps.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <string>

namespace hybrid_slam::files {

/// A serialised COccupancyGridMap2D (`.gridmap`), plain or gzipped, of at most 2^28 cells. It is checked
/// before MRPT builds it: MRPT believes its size, and does not notice a damaged gzip file.
/// @throws InputError for a missing file and for one that is no grid map, cut off or damaged
mrpt::maps::COccupancyGridMap2D readGridMap(const std::string& file);

}  // namespace hybrid_slam::files
