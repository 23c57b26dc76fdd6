/// @file NormalizedError.h
/// @brief Normalised estimation error squared (NEES), which checks a trajectory's covariances.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::evaluation {

/// How the errors compare with the covariances.
struct NormalizedErrors {
  size_t pairs = 0;     ///< poses with a reference pose
  double mean = 0;      ///< of e^T P^-1 e over (x, y, phi): 3 if the covariances are right
  double inside95 = 0;  ///< share of the poses below 7.815: 95 % if the errors are normal
};

/// Reads `timestamp,xx,xy,yy,xphi,yphi,phiphi` (m, rad) under a header line.
/// @throws InputError as readNumberTable, and for a covariance beyond 1e14
std::vector<Eigen::Matrix3d> loadCovariances(const std::string& file);

/// Both trajectories are taken relative to their first common pose, where the map frame begins.
/// @param covariances  one for each estimated pose
/// @param tolerance    s; largest time difference between a pose and its reference pose
/// @throws InputError if the trajectories have no pose in common, the number of covariances differs, or one
///         is not invertible or too small for its error
NormalizedErrors normalizedErrors(const files::Trajectory& estimate,
                                  const std::vector<Eigen::Matrix3d>& covariances,
                                  const files::Trajectory& reference, double tolerance);

}  // namespace hybrid_slam::evaluation
