/// @file CircleFit.h
/// @brief Least-squares circle through points of an arc.
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "slam/lines/Segmentation.h"

namespace hybrid_slam {

/// A circle and how well points determine it.
struct FittedCircle {
  mrpt::math::TPoint2D centre;  ///< m
  double radius = 0;            ///< m
  double squares = 0;           ///< sum of the squared distances of the points from the circle, m^2
  /// (J^T J)^-1 with J the derivative of the distances by centre and radius: the covariance of these for
  /// distances of variance 1.
  Eigen::Matrix3d cofactor = Eigen::Matrix3d::Zero();
};

/// Fits a circle by Taubin's algebraic method (1991), which is nearly unbiased also for short arcs, and
/// refines it by Gauss-Newton on the distances. Empty for fewer than four points, points on a line, or
/// divergence.
std::optional<FittedCircle> fitCircle(PointRange points);

}  // namespace hybrid_slam
