/// @file Association.h
/// @brief Which pose of the reference belongs to which pose of the estimate.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::evaluation {

struct PosePair {
  double timestamp = 0;                         ///< of the estimate, s
  mrpt::math::TPose2D estimate{}, reference{};  ///< each in the frame of its own trajectory; m, rad
};

/// Each pose of the estimate, in its file order, with the pose of the reference that is nearest in time;
/// poses without a reference within the tolerance (s) are left out.
/// @throws InputError if none is left: the two do not overlap in time.
std::vector<PosePair> associate(const files::Trajectory& estimate, const files::Trajectory& reference,
                                double tolerance);

/// "12.5..20.25 s", from the smallest to the largest stamp, for error messages.
std::string timeSpan(const files::Trajectory& trajectory);

}  // namespace hybrid_slam::evaluation
