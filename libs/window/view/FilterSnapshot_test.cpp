#include "window/view/FilterSnapshot.h"

#include <gtest/gtest.h>

namespace hybrid_slam::window {
namespace {

TEST(UncertaintyEllipse, FollowsTheParticles) {
  std::vector<WeightedPose> poses;
  for (const double t : {-1., 1.}) poses.push_back({{3 + t, 4 + t, 0}, 0});
  poses.push_back({{100, 0, 0}, -1000});  // has no weight
  const UncertaintyEllipse e = uncertaintyOf(poses);
  EXPECT_NEAR(e.centre.x, 3, 1e-9);
  EXPECT_NEAR(e.centre.y, 4, 1e-9);
  EXPECT_NEAR(e.major, std::sqrt(2), 1e-9);
  EXPECT_NEAR(e.minor, 0, 1e-6);
  EXPECT_NEAR(e.direction, M_PI / 4, 1e-9);
}

}  // namespace
}  // namespace hybrid_slam::window
