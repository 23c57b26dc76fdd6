/// @file ReturnError.h
/// @brief How far off the robot believes to be when it comes back: the error that a loop closure has to undo.
#pragma once

#include "files/Trajectory.h"

namespace hybrid_slam::comparison {

struct ReturnError {
  double translation = 0;  ///< m
  double rotation = 0;     ///< rad, in [0, pi]
};

/// inverse(motion of the reference) + (motion of the estimate), both from the first pose that the two have in
/// common to the last one: no alignment enters.
/// @param tolerance  s; between a pose and the reference pose it is compared with
/// @throws InputError if the two do not overlap in time
ReturnError returnError(const files::Trajectory& estimate, const files::Trajectory& reference,
                        double tolerance);

}  // namespace hybrid_slam::comparison
