#include "base/PoseDistance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

TEST(PoseDistance, HeadingsAreComparedAroundTheCircle) {
  const TPose2D a(1, 2, 3), b(4, 6, -3);
  EXPECT_NEAR(distanceBetween(a, b), 5, 1e-12);
  EXPECT_NEAR(angleBetween(a, b), 2 * M_PI - 6, 1e-12);
  EXPECT_NEAR(angleBetween(b, a), 2 * M_PI - 6, 1e-12);
}

TEST(PoseDistance, WithinNeedsBoth) {
  const TPose2D a(1, 2, 3), b(4, 6, -3);
  EXPECT_TRUE(isWithin(a, b, 5.1, 0.3));
  EXPECT_FALSE(isWithin(a, b, 4.9, 0.3));
  EXPECT_FALSE(isWithin(a, b, 5.1, 0.2));
}

TEST(PoseDistance, LengthsGrowAlongAPath) {
  EXPECT_THAT(lengthsAlong({{0, 0, 0}, {3, 4, 1}, {3, 4, 2}, {3, 3, 0}}), testing::ElementsAre(0, 5, 5, 6));
  EXPECT_THAT(lengthsAlong({}), testing::IsEmpty());
}

}  // namespace
}  // namespace hybrid_slam
