/// @file RelativePoseError.h
/// @brief Relative pose error (RPE): drift over a fixed time or distance.
#pragma once

#include <cstddef>

#include "files/Trajectory.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

/// The time or distance between the two poses of a pair.
struct RpeDelta {
  enum class Unit { seconds, metres };
  double length = 1;
  Unit unit = Unit::metres;
};

/// The errors over all pairs.
struct RpeErrors {
  size_t pairs = 0;             ///< pose pairs
  ErrorStatistics translation;  ///< m
  ErrorStatistics rotation;     ///< rad
};

/// Computes the errors inverse(inverse(r_i) + r_j) + (inverse(p_i) + p_j) of the estimate p against the
/// reference r. Each pose i is paired with the later pose j whose time, or distance along the reference, from
/// i is closest to delta. A pair counts if it is within 10 % of delta and the trajectory does not end before.
/// Distance is summed in file order.
/// @param tolerance  s; largest time difference between a pose and its reference pose
/// @throws InputError if the two do not overlap in time or have no poses that far apart.
RpeErrors relativePoseError(const files::Trajectory& estimate, const files::Trajectory& reference,
                            const RpeDelta& delta, double tolerance);

}  // namespace hybrid_slam::evaluation
