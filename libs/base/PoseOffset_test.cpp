#include "base/PoseOffset.h"

#include <gtest/gtest.h>

#include "base/Degree.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

TEST(PoseOffset, IsInFixedAxesAndTheShorterWayRound) {
  const Eigen::Vector3d off = offsetOf({1, 5, -170 * kDegree}, {3, 4, 170 * kDegree});
  EXPECT_TRUE(off.isApprox(Eigen::Vector3d(-2, 1, 20 * kDegree), 1e-12)) << off.transpose();
}

TEST(PoseOffset, IsUndoneByADisplacement) {
  const TPose2D from(3, 4, 170 * kDegree), to(1, 5, -170 * kDegree);
  const TPose2D again = displaced(from, offsetOf(to, from));
  EXPECT_NEAR(again.x, to.x, 1e-12);
  EXPECT_NEAR(again.y, to.y, 1e-12);
  EXPECT_NEAR(again.phi, to.phi, 1e-12) << "the heading is in [-pi, pi]";
}

}  // namespace
}  // namespace hybrid_slam
