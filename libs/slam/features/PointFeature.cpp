#include "slam/features/PointFeature.h"

#include <mrpt/math/wrap2pi.h>

namespace hybrid_slam {

PointFeature transformed(const PointFeature& feature, const mrpt::math::TPose2D& frame) {
  PointFeature result = feature;
  result.position = frame.composePoint(feature.position);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(frame.phi).toRotationMatrix();
  result.covariance = turn * feature.covariance * turn.transpose();
  result.covariance(1, 0) = result.covariance(0, 1);  // rounding
  result.direction = mrpt::math::wrapToPi(feature.direction + frame.phi);
  return result;
}

}  // namespace hybrid_slam
