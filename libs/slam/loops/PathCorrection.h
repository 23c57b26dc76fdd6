/// @file PathCorrection.h
/// @brief Moves a path with some of its poses.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

namespace hybrid_slam {

/// Returns the path through the new poses of its nodes. Between two nodes, the change of the motion from one
/// to the other is distributed by index; after the last node the path keeps its motions.
/// @param path   map frame
/// @param nodes  ascending indices of the path, from 0 on
/// @param moved  the new pose of each node
std::vector<mrpt::math::TPose2D> corrected(const std::vector<mrpt::math::TPose2D>& path,
                                           const std::vector<size_t>& nodes,
                                           const std::vector<mrpt::math::TPose2D>& moved);

}  // namespace hybrid_slam
