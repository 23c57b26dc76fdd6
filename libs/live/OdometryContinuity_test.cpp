#include "live/OdometryContinuity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "testing/TestLogs.h"

namespace hybrid_slam::live {
namespace {

using mrpt::math::TPose2D;

TEST(OdometryContinuity, ChangesNothingUntilARestart) {
  OdometryContinuity odometry;
  const TPose2D first(0.1, 0.2, 3.1), second(0.3, 0.7, -3.1);
  EXPECT_EQ(odometry(first), first);
  EXPECT_EQ(odometry(second), second);
  OdometryContinuity early;
  early.restart();
  EXPECT_EQ(early(first), first) << "there is no pose to continue from";
}

TEST(OdometryContinuity, ContinuesFromTheLastPose) {
  OdometryContinuity odometry;
  odometry({2, 1, M_PI / 2});
  odometry.restart();
  EXPECT_EQ(odometry({0, 0, 0}), TPose2D(2, 1, M_PI / 2));
  const TPose2D next = odometry({1, 0, 0.1});
  EXPECT_NEAR(next.x, 2, 1e-12);
  EXPECT_NEAR(next.y, 2, 1e-12);
  EXPECT_NEAR(next.phi, M_PI / 2 + 0.1, 1e-12);
  odometry.restart();
  EXPECT_NEAR(odometry({7, 7, 0}).y, 2, 1e-12) << "twice";
}

TEST(OdometryContinuity, AnImpossibleJumpIsARestart) {
  OdometryContinuity odometry;
  odometry({1000, 0, 0});
  EXPECT_EQ(odometry({1001, 0, 0}).x, 1001);
  EXPECT_EQ(odometry({0, 0, 0}).x, 1001);
  EXPECT_EQ(odometry({0.5, 0, 0}).x, 1001.5);
}

TEST(OdometryContinuity, ImpossibleOdometryIsIgnored) {
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), 1e30}) {
    OdometryContinuity odometry;
    rebase(*test::odometry(0, {wrong, 0, 0}), odometry);
    rebase(*test::odometry(1, {1, 0, 0}), odometry);
    odometry.restart();
    const auto reading = test::odometry(2, {wrong, 0, 0});
    rebase(*reading, odometry);
    EXPECT_TRUE(!(reading->odometry.x() < 1e29)) << "unchanged";
    rebase(*test::scan(3), odometry);
    const auto next = test::odometry(4, {0, 0, 0});
    rebase(*next, odometry);
    EXPECT_EQ(next->odometry.x(), 1);
  }
}

}  // namespace
}  // namespace hybrid_slam::live
