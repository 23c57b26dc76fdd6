#include "readings/OdometryTrack.h"

#include <gtest/gtest.h>

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;

TEST(OdometryTrack, IsLinearBetweenTheReadingsAndBeyondThem) {
  OdometryTrack track(1);
  track.add(10, {0, 0, 3});
  track.add(10.5, {1, 2, -3});  // by way of pi
  track.add(11, {1, 2, -3});
  EXPECT_NEAR(track.at(10.25).x, 0.5, 1e-12);
  EXPECT_NEAR(track.at(10.25).y, 1, 1e-12);
  EXPECT_NEAR(std::abs(track.at(10.25).phi), M_PI, 1e-12);
  EXPECT_NEAR(track.at(9.75).x, -0.5, 1e-12);
  EXPECT_NEAR(track.at(9.75).phi, 6 - M_PI, 1e-12);
  EXPECT_NEAR(track.at(8).x, -1, 1e-12) << "at most the first step";
  EXPECT_EQ(track.at(11.3), TPose2D(1, 2, -3)) << "it stood at last";
  track.add(11.5, {2, 2, -3});
  EXPECT_NEAR(track.at(11.75).x, 2.5, 1e-12);
}

TEST(OdometryTrack, KnowsWhatItCovers) {
  OdometryTrack track(1);
  EXPECT_FALSE(track.contains(10));
  EXPECT_FALSE(track.mayReach(10));
  track.add(10, {});
  EXPECT_EQ(track.at(10.5), TPose2D());
  track.add(10.5, {});
  EXPECT_TRUE(track.contains(10));
  EXPECT_TRUE(track.contains(10.5));
  EXPECT_FALSE(track.contains(10.6));
  EXPECT_FALSE(track.contains(9.9));
  EXPECT_TRUE(track.mayReach(11.5));
  EXPECT_FALSE(track.mayReach(11.6));
  EXPECT_FALSE(track.mayReach(9.9));
}

TEST(OdometryTrack, BeginsAgainAfterAGapOrAStepBack) {
  OdometryTrack track(1);
  track.add(10, {});
  track.add(10.5, {1, 0, 0});
  track.add(12, {2, 0, 0});
  EXPECT_FALSE(track.contains(11));
  EXPECT_TRUE(track.contains(12));
  track.add(5, {});
  EXPECT_FALSE(track.contains(12));
  EXPECT_TRUE(track.contains(5));
}

TEST(OdometryTrack, TheLastReadingOfATimeCounts) {
  OdometryTrack track(1);
  track.add(10, {});
  track.add(11, {1, 0, 0});
  track.add(11, {2, 0, 0});
  EXPECT_NEAR(track.at(10.5).x, 1, 1e-12);
}

}  // namespace
}  // namespace hybrid_slam::readings
