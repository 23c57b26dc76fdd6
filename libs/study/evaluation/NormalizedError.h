/// @file NormalizedError.h
/// @brief Normalised estimation error squared (NEES), which checks a trajectory's covariances.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "study/evaluation/RelationErrors.h"

namespace hybrid_slam::evaluation {

/// How the errors compare with the covariances.
struct NormalizedErrors {
  size_t pairs = 0;                     ///< poses with a reference pose; relations
  double mean = 0;                      ///< of e^T P^-1 e over (x, y, phi): 3 if the covariances are right
  double median = 0;                    ///< of the same: 2.4 if the errors are normal
  double inside95 = 0;                  ///< share of the pairs below 7.815: 95 % if the errors are normal
  Eigen::Vector3d insideAxes{0, 0, 0};  ///< the same for x, y and phi alone: within 1.96 standard deviations
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

/// The error of a relation is the trajectory's motion between its times, less its own.
/// @param covariances  of each of these errors: those of the trajectory and of the relation together
/// @throws InputError if a covariance is not invertible or too small for its error
NormalizedErrors normalizedErrors(const std::vector<PlacedRelation>& relations,
                                  const std::vector<Eigen::Matrix3d>& covariances);

}  // namespace hybrid_slam::evaluation
