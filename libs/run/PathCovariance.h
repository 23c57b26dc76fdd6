/// @file PathCovariance.h
/// @brief Uncertainty of a finished path in the map frame: covariance.csv.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <ostream>
#include <vector>

#include "files/Trajectory.h"
#include "slam/filter/FilterView.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam::run {

/// Covariance of (x, y, phi), map frame; m, rad.
using PoseCovariance = Eigen::Matrix3d;

/// Covariance of the weighted particles; zero without particles.
PoseCovariance covarianceOf(const std::vector<WeightedPose>& particles);

/// Covariance of each pose of the path with respect to the first: a random walk along the path, or along a
/// short cut through a place where returning scans agree with the map; plus the spread of the particles.
/// @param path       a pose for each update
/// @param particles  the covariance of the particles at each update
/// @param returning  scans compared with what was mapped before; those not contradicted are short cuts
/// @param hasLines   line directions keep the heading: the path drifts less
std::vector<PoseCovariance> pathCovariances(const std::vector<mrpt::math::TPose2D>& path,
                                            const std::vector<PoseCovariance>& particles,
                                            const std::vector<Revisit>& returning, bool hasLines);

/// Writes `timestamp,xx,xy,yy,xphi,yphi,phiphi`, one row per pose of the trajectory. Between two updates, the
/// covariance of the earlier one grows by the motion since.
/// @param updates  for each row of the trajectory, the number of updates up to it
void writeCovariances(std::ostream& out, const files::Trajectory& trajectory,
                      const std::vector<size_t>& updates, const std::vector<mrpt::math::TPose2D>& path,
                      const std::vector<PoseCovariance>& covariances);

}  // namespace hybrid_slam::run
