/// @file AbsoluteTrajectoryError.h
/// @brief How far an estimated trajectory is from the reference as a whole.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

#include "files/Trajectory.h"
#include "study/evaluation/Association.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

struct AteErrors {
  size_t pairs = 0;                 ///< poses of the estimate that have a reference
  ErrorStatistics translation;      ///< m
  mrpt::math::TPose2D alignment{};  ///< the estimate's frame in the reference's frame; m, rad
};

/// Distances between the positions of the reference and those of the estimate after the rigid motion (no
/// scale) that makes their squares' sum least.
/// @param tolerance  s; between a pose and the reference pose it is compared with
/// @throws InputError if the two have fewer than 2 poses in common: any one position can be aligned away.
AteErrors absoluteTrajectoryError(const files::Trajectory& estimate, const files::Trajectory& reference,
                                  double tolerance);

/// The motion a of SE(2) with least sum |a + estimate - reference|^2 over the positions of the pairs: the
/// planar case of Horn (1987) and Umeyama (1991).
mrpt::math::TPose2D rigidAlignment(const std::vector<PosePair>& pairs);

}  // namespace hybrid_slam::evaluation
