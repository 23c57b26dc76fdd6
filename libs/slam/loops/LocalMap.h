/// @file LocalMap.h
/// @brief A short part of the path and the map made there, taken as rigid.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"
#include "slam/loops/PoseGraph.h"

namespace hybrid_slam {

/// The data of an update that LoopCloser keeps: its index and its beams.
struct Keyframe {
  size_t update = 0;  ///< index of the path
  ScanBeams beams;

  template <class State>
  void visit(State& state) {
    state(update, beams);
  }
};

/// The map of some keyframes, in the frame of one of them; or a part of the map of an earlier run.
struct LocalMap {
  size_t reference = 0;  ///< keyframe that defines the frame, or PoseEdge::kMapFrame
  OccupancyGrid grid;
  ScanBeams ends;  ///< one beam end for each occupied cell, from the reference
};

/// The map of keyframes [first, last) in the frame of the middle one.
/// @param poses    of all keyframes, map frame
/// @param options  its resolution is that of the map
LocalMap localMap(const std::vector<Keyframe>& keyframes, const std::vector<mrpt::math::TPose2D>& poses,
                  size_t first, size_t last, const GridOptions& options);

/// The cells of a map within `reach` (m, in x and in y) of a place, in the frame of the map.
/// @param resolution  m; an occupied cell makes the coarser cell around it occupied
LocalMap localMap(const OccupancyGrid& map, const mrpt::math::TPoint2D& place, double reach,
                  double resolution);

}  // namespace hybrid_slam
