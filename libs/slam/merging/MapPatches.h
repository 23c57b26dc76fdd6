/// @file MapPatches.h
/// @brief Cuts a map into local maps, to find them in another map piece by piece.
#pragma once

#include <vector>

#include "slam/loops/LocalMap.h"

namespace hybrid_slam {

/// A piece of a map. Its axes are those of the map.
struct MapPatch {
  mrpt::math::TPose2D place;  ///< its frame in that of the map (m, rad); in a free cell
  LocalMap map;
};

/// Returns the whole map as one patch.
/// @param place  the origin of its frame
MapPatch wholeMap(const OccupancyGrid& grid, const mrpt::math::TPose2D& place);

/// Returns squares of 12 m around free places about 4 m apart, at most 250. Omits those with less than 4 m of
/// wall.
std::vector<MapPatch> patchesOf(const OccupancyGrid& grid);

}  // namespace hybrid_slam
