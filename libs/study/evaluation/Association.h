/// @file Association.h
/// @brief Association of estimated and reference poses by time.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::evaluation {

/// An estimated pose and its reference.
struct PosePair {
  double timestamp = 0;                         ///< of the estimate, s
  mrpt::math::TPose2D estimate{}, reference{};  ///< each in its trajectory's frame; m, rad
  size_t estimateRow = 0, referenceRow = 0;     ///< of the trajectories
};

/// Each estimated pose, in file order, with the reference pose nearest in time (StampSequence); poses without
/// one within the tolerance (s) are skipped.
/// @throws InputError if there is no pair: the trajectories do not overlap in time.
std::vector<PosePair> associate(const files::Trajectory& estimate, const files::Trajectory& reference,
                                double tolerance);

/// "12.5..20.25 s", from the smallest to the largest timestamp, for error messages.
std::string timeSpan(const files::Trajectory& trajectory);

}  // namespace hybrid_slam::evaluation
