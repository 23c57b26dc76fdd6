/// @file MapMerging.h
/// @brief One map of two.
#pragma once

#include <vector>

#include "slam/merging/MapPlacement.h"

namespace hybrid_slam {

/// A map and, if it is ours, how it was made.
struct MapPart {
  ScanMap map;
  std::vector<mrpt::math::TPose2D> path;  ///< a pose for each update, map frame (m, rad); may be empty
  std::vector<Scans> scans;               ///< of each update; empty: not known
};

struct MergedMap {
  mrpt::math::TPose2D frame;                      ///< of the newer map in that of the older (m, rad)
  ScanMap map;                                    ///< in the frame and the cells of the older map
  std::vector<mrpt::math::TPose2D> older, newer;  ///< the paths in it
};

/// Joins two maps.
///
/// Where the scans of both are known, the pose graph of both paths and of the patches that agree spreads what
/// a rigid motion leaves, all scans are matched to the common map, and the map is built of all scans. Scans
/// of the newer map alone are matched to the older one. A map without scans keeps its shape: its cells are
/// added.
///
/// @param placement      of the newer map in the older
/// @param configuration  of the older map
MergedMap merged(const MapPart& older, const MapPart& newer, const MapPlacement& placement,
                 const FilterConfiguration& configuration);

}  // namespace hybrid_slam
