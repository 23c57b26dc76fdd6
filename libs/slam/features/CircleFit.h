/// @file CircleFit.h
/// @brief Least-squares circle through points of an arc.
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "slam/lines/Segmentation.h"

namespace hybrid_slam {

struct FittedCircle {
  mrpt::math::TPoint2D centre;  ///< m
  double radius = 0;            ///< m
  double squares = 0;           ///< sum of the squared distances of the points from the circle, m^2
  /// (J^T J)^-1 of the distances by centre and radius: their covariance for distances of variance 1.
  Eigen::Matrix3d cofactor = Eigen::Matrix3d::Zero();
};

/// The algebraic fit of Taubin (1991), which is nearly unbiased also for short arcs, improved by Gauss-Newton
/// steps of the distances. Empty for fewer than four points, points on a line, or steps that diverge.
std::optional<FittedCircle> fitCircle(PointRange points);

}  // namespace hybrid_slam
