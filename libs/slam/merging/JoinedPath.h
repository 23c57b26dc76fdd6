/// @file JoinedPath.h
/// @brief Two paths in one frame, bent so that both see the same places alike.
#pragma once

#include <vector>

#include "slam/merging/MapPlacement.h"

namespace hybrid_slam {

/// Optimises the pose graph of both paths. Its edges are the motions along each path, the relative poses
/// where a path returns to a place, and those of the patches that both maps show.
/// @param older    a pose for each update, m and rad; the first one stays
/// @param newer    likewise, in the same frame
/// @param frame    of the map that `newer` comes from
/// @param patches  of it
void joinPaths(std::vector<mrpt::math::TPose2D>& older, std::vector<mrpt::math::TPose2D>& newer,
               const mrpt::math::TPose2D& frame, const std::vector<PatchMatch>& patches);

}  // namespace hybrid_slam
