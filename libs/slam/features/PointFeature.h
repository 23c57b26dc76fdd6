/// @file PointFeature.h
/// @brief A point of the surroundings that a scan shows: a corner of two walls, or the centre of an arc.
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <cmath>

namespace hybrid_slam {

enum class FeatureKind {
  concaveCorner,  ///< as of a room, seen from inside
  convexCorner,   ///< as of a building, seen from outside
  pillar,         ///< an arc that bulges towards the laser
  hall            ///< an arc around the laser
};

struct PointFeature {
  FeatureKind kind = FeatureKind::concaveCorner;
  mrpt::math::TPoint2D position;                             ///< m, in the feature's frame
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of the position, m^2
  double direction = 0;                                      ///< corner: bisector of its walls, rad
  double radius = 0, radiusVariance = 0;                     ///< arc: m, m^2

  bool isCorner() const { return kind == FeatureKind::concaveCorner || kind == FeatureKind::convexCorner; }

  template <class State>
  void visit(State& state) {
    state(kind, position, covariance, direction, radius, radiusVariance);
    const bool isPositive = covariance(0, 0) > 0 && covariance.determinant() > 0 && covariance.trace() < 1e6;
    state.check(FeatureKind::concaveCorner <= kind && kind <= FeatureKind::hall && isPositive &&
                    covariance(0, 1) == covariance(1, 0) && std::abs(direction) < 1e3 && radius >= 0 &&
                    radius < 1e6 && radiusVariance >= 0 && radiusVariance < 1e6,
                "a feature is impossible");
  }
};

/// Transforms a feature from `frame` to the frame that `frame` is given in (sensor -> robot -> map).
PointFeature transformed(const PointFeature& feature, const mrpt::math::TPose2D& frame);

}  // namespace hybrid_slam
