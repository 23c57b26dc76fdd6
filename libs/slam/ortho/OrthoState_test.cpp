#include "slam/ortho/OrthoState.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/Degree.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

OrthoState moved(const TPose2D& odometry) {
  OrthoState state;
  state.move(odometry, MotionModelOptions());
  return state;
}

TEST(OrthoState, MovesAsTheMotionModel) {
  const TPose2D odometry(1, 0.1, 20 * kDegree);
  const OrthoState state = moved(odometry);
  const MotionDistribution expected = motionDistribution({}, odometry, MotionModelOptions());
  EXPECT_TRUE(state.poseCovariance().isApprox(expected.covariance, 1e-12));
  EXPECT_NEAR(state.pose().x, expected.mean.x, 1e-12);
  EXPECT_NEAR(state.pose().phi, expected.mean.phi, 1e-12);
}

/// The uncertainty of a heading becomes one of position 10 m farther on.
TEST(OrthoState, TheHeadingMovesThePosition) {
  MotionModelOptions exact;
  exact.distance = exact.drift = {1, 0, 0, 0};
  exact.drift.meanD = 0;
  exact.turn = {0, 1, 0, 0};
  exact.minStdXY = exact.minStdPhi = 0;
  OrthoState state;
  state.turnFrame(0, kDegree * kDegree);
  state.move({10, 0, 0}, exact);
  EXPECT_NEAR(state.pose().x, 10, 1e-9);
  EXPECT_NEAR(state.poseCovariance()(1, 1), std::pow(10 * kDegree, 2), 1e-9);
  EXPECT_NEAR(state.poseCovariance()(1, 2), 10 * kDegree * kDegree, 1e-9);
}

TEST(OrthoState, AMeasurementIsWeighedByItsVariance) {
  OrthoState state = moved({1, 0, 0});
  const double before = state.poseCovariance()(0, 0), variance = 0.01;
  OrthoState::Measurement measurement = state.measurement(0.2, variance);
  measurement.byState[0] = 1;
  EXPECT_NEAR(state.squaredDistance(measurement), 0.04 / (before + variance), 1e-9);
  state.correct(measurement);
  EXPECT_NEAR(state.pose().x, 1 + 0.2 * before / (before + variance), 1e-9);
  EXPECT_NEAR(state.poseCovariance()(0, 0), before * variance / (before + variance), 1e-9);
}

/// A line is as uncertain as the pose that saw it, but not relative to that pose.
TEST(OrthoState, ALineIsCorrelatedWithThePose) {
  OrthoState state = moved({1, 0, 0});
  const double pose = state.poseCovariance()(0, 0);
  state.add(4, {1, 0, 0}, 0.01);
  ASSERT_EQ(state.lines(), 1u);
  EXPECT_EQ(state.offset(0), 4);
  OrthoState::Measurement again = state.measurement(1, 0);
  again.byState[3] = 1;
  EXPECT_NEAR(1 / state.squaredDistance(again), pose + 0.01, 1e-12);
  again.byState[0] = -1;
  EXPECT_NEAR(1 / state.squaredDistance(again), 0.01, 1e-12);
}

TEST(OrthoState, TheOthersStayWhenALineIsRemoved) {
  OrthoState state = moved({1, 0.5, 10 * kDegree});
  for (const double offset : {1, 2, 3}) state.add(offset, {1, 0, offset}, 0.01 * offset);
  const auto distanceOf = [&state](size_t line) {
    OrthoState::Measurement difference = state.measurement(1, 0.01);
    difference.byState[OrthoState::index(line)] = 1;
    difference.byState[1] = 0.3;
    return state.squaredDistance(difference);
  };
  const double first = distanceOf(0), third = distanceOf(2);
  state.remove(1);
  ASSERT_EQ(state.lines(), 2u);
  EXPECT_EQ(state.offset(1), 3);
  EXPECT_NEAR(distanceOf(0), first, 1e-12);
  EXPECT_NEAR(distanceOf(1), third, 1e-12);
}

TEST(OrthoState, TheFrameTurnsUnderTheRobot) {
  OrthoState state = moved({2, 0, 0});
  const double along = state.poseCovariance()(0, 0);
  state.turnFrame(90 * kDegree, 0.25);
  EXPECT_NEAR(state.pose().x, 0, 1e-9);
  EXPECT_NEAR(state.pose().y, -2, 1e-9);
  EXPECT_NEAR(state.pose().phi, -90 * kDegree, 1e-9);
  EXPECT_NEAR(state.poseCovariance()(1, 1), along, 1e-12);
  EXPECT_GT(state.poseCovariance()(2, 2), 0.25);
}

}  // namespace
}  // namespace hybrid_slam
