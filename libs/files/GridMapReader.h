/// @file GridMapReader.h
/// @brief Reads MRPT's grid maps.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <string>

namespace hybrid_slam::files {

/// Reads a serialised COccupancyGridMap2D (`.gridmap`), plain or gzipped, of at most 2^28 cells. Checks it
/// before MRPT builds it: MRPT trusts its size, and does not detect a damaged gzip file.
/// @throws InputError for a file that is missing, not a grid map, cut off or damaged
mrpt::maps::COccupancyGridMap2D readGridMap(const std::string& file);

}  // namespace hybrid_slam::files
