/// @file AbsoluteTrajectoryError.h
/// @brief Absolute trajectory error (ATE).
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

#include "files/Trajectory.h"
#include "study/evaluation/Association.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

/// The errors of a trajectory after its alignment.
struct AteErrors {
  size_t pairs = 0;                 ///< poses with a reference pose
  ErrorStatistics translation;      ///< m
  mrpt::math::TPose2D alignment{};  ///< of the estimate's frame in the reference frame; m, rad
};

/// Distances between reference and estimated positions after the rigid alignment (no scale) with the least
/// sum of squares.
/// @param tolerance  s; largest time difference between a pose and its reference pose
/// @throws InputError if the two share fewer than 2 poses: a single position can always be aligned.
AteErrors absoluteTrajectoryError(const files::Trajectory& estimate, const files::Trajectory& reference,
                                  double tolerance);

/// The rigid motion a in SE(2) that minimises sum |a + estimate - reference|^2 over the positions: the planar
/// case of Horn (1987) and Umeyama (1991).
mrpt::math::TPose2D rigidAlignment(const std::vector<PosePair>& pairs);

}  // namespace hybrid_slam::evaluation
