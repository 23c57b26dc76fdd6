/// @file MapMerging.h
/// @brief Merges two maps.
#pragma once

#include <vector>

#include "slam/merging/MapPlacement.h"

namespace hybrid_slam {

/// A map with its path and scans, if it is ours.
struct MapPart {
  ScanMap map;
  std::vector<mrpt::math::TPose2D> path;  ///< a pose for each update, map frame (m, rad); may be empty
  std::vector<Scans> scans;               ///< of each update; empty: not known
};

/// The map of both.
struct MergedMap {
  mrpt::math::TPose2D frame;                      ///< of the newer map in that of the older (m, rad)
  ScanMap map;                                    ///< in the frame and the cells of the older map
  std::vector<mrpt::math::TPose2D> older, newer;  ///< the two paths in the same frame
};

/// Joins two maps.
///
/// If the newer scans are known, the filter runs over them again. From the first scan that the older map
/// explains, it continues that map. This removes the drift between the maps, which a rigid motion cannot. All
/// known scans are then matched to the common map. A map without scans keeps its shape: its cells are added.
///
/// @param placement      of the newer map in the older
/// @param configuration  of the older map
MergedMap merged(const MapPart& older, const MapPart& newer, const MapPlacement& placement,
                 const FilterConfiguration& configuration);

}  // namespace hybrid_slam
