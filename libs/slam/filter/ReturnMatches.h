/// @file ReturnMatches.h
/// @brief Matches of scans taken on a return to the map of the earlier visit.
#pragma once

#include <mrpt/core/bits_math.h>

#include <vector>

#include "slam/filter/PathScans.h"
#include "slam/loops/PoseGraph.h"

namespace hybrid_slam {

/// Least standard deviations of a match: in x, y (m) and heading (rad).
const Eigen::Vector3d kBestMatch(0.005, 0.005, mrpt::DEG2RAD(0.05));
/// Standard deviations of a match about an expected pose: in x, y (m) and heading (rad).
const Eigen::Vector3d kExpectedMatch(0.1, 0.1, mrpt::DEG2RAD(1.0));
/// m of path between the scans of a map that scans are matched to.
constexpr double kMapInterval = 0.6;
/// Fit below which a match fails; on a map of one scan, the fit is 0.04 (with the default `grid.p_hit`).
constexpr double kLeastFit = 0.1;

/// Matches each node within 3 m of an earlier one to the map that the path made around the nearest of these,
/// at least RevisitCheck::kReturn (m) of path before. A node whose match fails has no edge.
///
/// The match starts at the path's pose. The filter may have drawn the robot to a wrong place of the old
/// walls, such as half a metre along a corridor. A scan that fits better elsewhere, up to half a metre away,
/// is matched there if at least three others, and two thirds of those within 5 m of path, are off the path by
/// the same (within 0.1 m). A single scan may fit better elsewhere because furniture was moved.
/// @param nodes    indices of the path
/// @param threads  0: all cores; does not affect the result
/// @return edges between nodes, ascending by the later one
std::vector<PoseEdge> returnMatches(const PathScans& scans, const std::vector<size_t>& nodes, int threads);

}  // namespace hybrid_slam
