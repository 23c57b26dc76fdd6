/// @file ReturnError.h
/// @brief Pose error on return to the start: the error that loop closure must correct.
#pragma once

#include "files/Trajectory.h"

namespace hybrid_slam::comparison {

/// The error of the motion from the first to the last pose.
struct ReturnError {
  double translation = 0;  ///< m
  double rotation = 0;     ///< rad, in [0, pi]
};

/// inverse(motion of the reference) + (motion of the estimate), both from the first to the last common pose;
/// needs no alignment.
/// @param tolerance  s; between a pose and the reference pose it is compared with
/// @throws InputError if the two do not overlap in time
ReturnError returnError(const files::Trajectory& estimate, const files::Trajectory& reference,
                        double tolerance);

}  // namespace hybrid_slam::comparison
