/// @file FeatureLikelihood.h
/// @brief Likelihood of a scan's corners, wall ends and arcs given a particle's pose.
#pragma once

#include <vector>

#include "slam/features/FeatureDatabase.h"
#include "slam/grid/LogDensity.h"

namespace hybrid_slam {

/// ln p(features | pose, feature database), up to a constant:
///
///   1/sqrt(n) sum_i ln max(exp(-d_i^2 / 2), floor),
///
/// d_i the Mahalanobis distance of the i-th of n features from the one of the database that it matches at the
/// predicted pose. The features of a scan share errors, of the map and of the walls that meet in them, so n
/// of them weigh as much as sqrt(n) independent ones. Features without match count as the floor, so that no
/// pose gains by losing a match. The value is in [sqrt(n) ln floor, 0]; it is 0 if no feature was seen or
/// none is known. Unlike lines, features determine the position in all directions.
class FeatureLikelihood {
 public:
  /// @param seen         robot frame, with the errors of the pose (`withModelError`)
  /// @param predicted    where to associate: the motion model's mean, or the pose to weigh
  /// @param uncertainty  covariance of the predicted pose (m, rad): it widens the gate of the association
  /// @param database     map frame
  FeatureLikelihood(const std::vector<PointFeature>& seen, const mrpt::math::TPose2D& predicted,
                    const Eigen::Matrix3d& uncertainty, const FeatureDatabase& database,
                    const FeatureOptions& options);

  LogDensity operator()(const mrpt::math::TPose2D& pose) const;

 private:
  struct Match {
    mrpt::math::TPoint2D seen, known;  ///< robot frame, map frame
    Eigen::Matrix2d information;       ///< of their difference, map frame, at the predicted pose
  };
  std::vector<Match> matches_;
  double share_ = 0;        ///< 1/sqrt(n)
  double mostSquares_ = 0;  ///< d^2 at the floor
  double unmatched_ = 0;    ///< contribution of the features without match
};

}  // namespace hybrid_slam
