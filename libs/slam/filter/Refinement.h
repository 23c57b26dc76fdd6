/// @file Refinement.h
/// @brief Refinement after the run: matches the best trajectory to the final map and rebuilds the map.
#pragma once

#include <optional>
#include <vector>

#include "slam/filter/FilterOptions.h"
#include "slam/filter/MapMaker.h"
#include "slam/loops/LoopClosure.h"
#include "slam/motion/MotionModel.h"

namespace hybrid_slam {

/// Closes the loops that a finished path leaves open, from its first update to its last. Assumes that no
/// motion slipped.
/// @param path       a pose for each update (map frame); corrected
/// @param scans      of each update; those of the last ones may be missing
/// @param direction  direction of the walls modulo 90 deg, rad; empty: unknown
std::vector<LoopClosure> closeLoops(std::vector<mrpt::math::TPose2D>& path, const std::vector<Scans>& scans,
                                    const std::optional<double>& direction,
                                    const FilterConfiguration& configuration);

/// Matches every scan, also those between two updates, against the map that all of them and `base` make,
/// `passes` times. A normal prior of 5 cm and 1 deg keeps each pose near its previous value; a match that
/// fits less than [improved_proposal] min_fit leaves it unchanged. The first pose is not fixed.
///
/// Where a scan shows little, as between two doors of a corridor, its pose follows the odometry. If that was
/// wrong, the pose is wrong by more than a match corrects, although later scans show where the robot was. So
/// each scan (but the first one without `base`) is also matched from the best pose up to half a metre ahead,
/// behind, left and right. It moves there if it fits clearly better there, and the path then departs from the
/// odometry by about as much as before; otherwise the scan may be right, and the walls of others wrong.
/// @param base      map to insert the scans into; empty: none
/// @param odometry  motion from each scan to the next, by the motion model (frame of the earlier scan's
/// pose);
///                  empty: unknown, so that no scan moves that far
void refine(std::vector<PosedScans>& scans, int passes, const FilterConfiguration& configuration,
            const std::optional<ScanMap>& base = {}, const std::vector<MotionDistribution>& odometry = {});

/// Moves all scans together so that the first one is at `pose`, as in a map that begins there.
void moveFirstTo(const mrpt::math::TPose2D& pose, std::vector<PosedScans>& scans);

}  // namespace hybrid_slam
