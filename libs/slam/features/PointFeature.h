/// @file PointFeature.h
/// @brief A point landmark in a scan: the corner of two walls, the end of a wall, or the centre of an arc.
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <cmath>

namespace hybrid_slam {

/// The kinds of features. Only those of the same kind are compared.
enum class FeatureKind {
  concaveCorner,  ///< of a room, seen from inside
  convexCorner,   ///< of a building, seen from outside
  pillar,         ///< an arc that bulges towards the laser
  hall,           ///< an arc around the laser
  wallEnd         ///< of a wall at an opening
};

/// A feature with its uncertainty, in a scan or in the map.
struct PointFeature {
  FeatureKind kind = FeatureKind::concaveCorner;
  mrpt::math::TPoint2D position;                             ///< m, in the feature's frame
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of the position, m^2
  double direction = 0;                   ///< corner: bisector of its walls; wall end: along the wall; rad
  double radius = 0, radiusVariance = 0;  ///< arc: m, m^2

  bool isArc() const { return kind == FeatureKind::pillar || kind == FeatureKind::hall; }

  template <class State>
  void visit(State& state) {
    state(kind, position, covariance, direction, radius, radiusVariance);
    const bool isPositive = covariance(0, 0) > 0 && covariance.determinant() > 0 && covariance.trace() < 1e6;
    state.check(FeatureKind::concaveCorner <= kind && kind <= FeatureKind::wallEnd && isPositive &&
                    covariance(0, 1) == covariance(1, 0) && std::abs(direction) < 1e3 && radius >= 0 &&
                    radius < 1e6 && radiusVariance >= 0 && radiusVariance < 1e6,
                "a feature is impossible");
  }
};

/// Transforms a feature from `frame` to the frame that `frame` is given in (sensor -> robot -> map).
PointFeature transformed(const PointFeature& feature, const mrpt::math::TPose2D& frame);

}  // namespace hybrid_slam
