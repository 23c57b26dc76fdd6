/// @file RelativePoseError.h
/// @brief How much an estimated trajectory drifts over a stretch of time or way.
#pragma once

#include <cstddef>

#include "files/Trajectory.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

/// The length of the stretch.
struct RpeDelta {
  enum class Unit { seconds, metres };
  double length = 1;
  Unit unit = Unit::metres;
};

struct RpeErrors {
  size_t pairs = 0;             ///< stretches
  ErrorStatistics translation;  ///< m
  ErrorStatistics rotation;     ///< rad
};

/// The errors inverse(inverse(r_i) + r_j) + (inverse(p_i) + p_j) of the estimate p against the reference r.
/// Every pose i begins one stretch; it ends at the pose j whose time, or way along the reference, after i is
/// nearest to delta, and counts if it is so within 10 % and the trajectory does not end before. Time is by
/// stamp; way adds up in file order.
/// @param tolerance  s; between a pose and the reference pose it is compared with
/// @throws InputError if the two do not overlap in time or hold no stretch of that length.
RpeErrors relativePoseError(const files::Trajectory& estimate, const files::Trajectory& reference,
                            const RpeDelta& delta, double tolerance);

}  // namespace hybrid_slam::evaluation
