#include "base/PoseRotation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybrid_slam {
namespace {

TEST(PoseRotation, RotatesPositionsAndKeepsHeadings) {
  const Eigen::Vector3d rotated = poseRotation(M_PI / 2) * Eigen::Vector3d(1, 2, 3);
  EXPECT_TRUE(rotated.isApprox(Eigen::Vector3d(-2, 1, 3), 1e-12)) << rotated;
}

TEST(PoseRotation, SwapsTheAxesOfACovarianceAtARightAngle) {
  Eigen::Matrix3d covariance, expected;
  covariance << 4, 0, 0.5, 0, 1, 0, 0.5, 0, 0.1;
  expected << 1, 0, 0, 0, 4, 0.5, 0, 0.5, 0.1;
  EXPECT_TRUE(rotated(covariance, M_PI / 2).isApprox(expected, 1e-12)) << rotated(covariance, M_PI / 2);
}

}  // namespace
}  // namespace hybrid_slam
