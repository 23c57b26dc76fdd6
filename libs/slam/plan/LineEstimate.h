/// @file LineEstimate.h
/// @brief A straight line with its covariance.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <Eigen/Core>
#include <cmath>

namespace hybrid_slam {

/// A directed line as an estimate of two numbers: its offset to the left (m) at a point of it, and its angle
/// (rad). Offset and angle are hardly correlated at the middle of the observed part.
struct LineEstimate {
  mrpt::math::TPoint2D at;                                   ///< m, on the line
  double angle = 0;                                          ///< rad, of its direction
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of (offset at `at`, angle)

  mrpt::math::TPoint2D direction() const { return {std::cos(angle), std::sin(angle)}; }
  double along(const mrpt::math::TPoint2D& p) const;   ///< m from `at`
  double offset(const mrpt::math::TPoint2D& p) const;  ///< m, positive on the left
  mrpt::math::TPoint2D point(double along) const { return at + direction() * along; }
  Eigen::Matrix2d covarianceAt(const mrpt::math::TPoint2D& p) const;  ///< of (offset beside p, angle)
  /// The same line in the other direction.
  LineEstimate reversed() const;
};

/// A line fitted to points along `length` (m), each with an error of `sigma` (m). Errors are independent
/// beyond 1 m: neighbouring points share the error of the poses that saw them.
LineEstimate lineThrough(const mrpt::math::TPoint2D& middle, double angle, double length, double sigma);

/// Squared Mahalanobis distance (2 degrees of freedom) of two lines of nearly the same direction, compared
/// at b.at.
double squaredDistance(const LineEstimate& a, const LineEstimate& b);

/// Fuses both: a Kalman update of `a`. Offset and angle are uncorrelated at the new `at`.
LineEstimate fused(const LineEstimate& a, const LineEstimate& b);

/// The estimate given a direction (rad) that is known with a variance (rad^2).
LineEstimate turnedTo(const LineEstimate& line, double angle, double variance);

}  // namespace hybrid_slam
