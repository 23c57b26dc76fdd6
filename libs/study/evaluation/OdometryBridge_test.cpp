#include "study/evaluation/OdometryBridge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/RandomStream.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPose2D;

/// Rows at the given stamps, each 1 m further along x.
files::Trajectory straightOdometry(const std::vector<double>& stamps) {
  files::Trajectory odometry;
  for (const double stamp : stamps) odometry.push_back({stamp, {static_cast<double>(odometry.size()), 0, 0}});
  return odometry;
}

void expectPose(const std::optional<TrajectoryPoint>& point, double x, double y, double phi) {
  ASSERT_TRUE(point.has_value());
  EXPECT_NEAR(point->pose.x, x, 1e-12);
  EXPECT_NEAR(point->pose.y, y, 1e-12);
  EXPECT_NEAR(point->pose.phi, phi, 1e-12);
}

TEST(OdometryBridge, SpreadsTheClosingErrorInEqualParts) {
  const files::Trajectory odometry = straightOdometry({0, 1, 2, 3, 4});
  const OdometryBridge bridge({{0, {0, 0, 0}}, {4, {4.4, 0.8, 0.2}}}, odometry, 0.006);
  expectPose(bridge.poseAt(0), 0, 0, 0);
  expectPose(bridge.poseAt(1), 1.1, 0.2, 0.05);
  expectPose(bridge.poseAt(3), 3.3, 0.6, 0.15);
  expectPose(bridge.poseAt(4), 4.4, 0.8, 0.2);
}

TEST(OdometryBridge, ContinuesInTheFrameOfTheLastPose) {
  const files::Trajectory odometry = straightOdometry({0, 1, 2, 3});
  const OdometryBridge bridge({{1, {10, 20, M_PI / 2}}}, odometry, 0.006);
  EXPECT_FALSE(bridge.poseAt(0).has_value()) << "before the first pose";
  expectPose(bridge.poseAt(1), 10, 20, M_PI / 2);
  expectPose(bridge.poseAt(3), 10, 22, M_PI / 2);
}

TEST(OdometryBridge, NamesThePoseThatItCarries) {
  const files::Trajectory odometry = straightOdometry({0, 1, 2, 3, 4});
  const OdometryBridge bridge({{0, {}}, {2, {2, 0, 0}}}, odometry, 0.006);
  for (const auto& [timestamp, row] : {std::pair(0.0, 0U), {1.0, 0U}, {2.0, 1U}, {4.0, 1U}})
    EXPECT_EQ(bridge.poseAt(timestamp)->row, row) << timestamp;
}

TEST(OdometryBridge, RowOrderIsUsedWhereTimeStepsBack) {
  const files::Trajectory odometry = straightOdometry({0, 1, 3, 2, 4});  // the robot was at x = 3 at stamp 2
  const OdometryBridge bridge({{0, {0, 0, 0}}, {4, {4, 0.4, 0}}}, odometry, 0.006);
  expectPose(bridge.poseAt(3), 2, 0.2, 0);
  expectPose(bridge.poseAt(2), 3, 0.3, 0);
}

TEST(OdometryBridge, HeadingErrorsAreSpreadTheShorterWay) {
  files::Trajectory odometry;
  for (int i = 0; i <= 4; ++i) odometry.push_back({static_cast<double>(i), {0, 0, 3.1}});
  // The turn from 3.1 to -3.1 is 2 pi - 6.2 forwards, not 6.2 backwards.
  const OdometryBridge bridge({{0, {0, 0, 3.1}}, {4, {0, 0, -3.1}}}, odometry, 0.006);
  expectPose(bridge.poseAt(1), 0, 0, 3.1 + (2 * M_PI - 6.2) / 4);
}

TEST(OdometryBridge, NeedsARowWithinTheToleranceAndNeverTakesMoreThan6Milliseconds) {
  const files::Trajectory odometry = straightOdometry({0, 1});
  const OdometryBridge bridge({{0, {0, 0, 0}}}, odometry, 0.05);
  EXPECT_TRUE(bridge.poseAt(1.005).has_value());
  EXPECT_FALSE(bridge.poseAt(1.007).has_value());
  const OdometryBridge narrow({{0, {0, 0, 0}}}, odometry, 0.001);
  EXPECT_FALSE(narrow.poseAt(1.002).has_value());
}

TEST(OdometryBridge, OfTwoPosesAtOneRowTheLaterInTheFileIsUsed) {
  const files::Trajectory odometry = straightOdometry({0, 1});
  const OdometryBridge bridge({{0, {5, 0, 0}}, {0, {7, 0, 0}}}, odometry, 0.006);
  expectPose(bridge.poseAt(1), 8, 0, 0);
}

TEST(OdometryBridge, PerfectOdometryGivesTheTruthFromAnySubset) {
  RandomStream random(3, 0, 0);
  for (int trial = 0; trial < 50; ++trial) {
    const TPose2D start{random.gaussian(), random.gaussian(), random.gaussian()};
    files::Trajectory odometry{{0, {0, 0, 0}}}, truth{{0, start}};
    for (int i = 1; i < 60; ++i) {
      const TPose2D step{random.gaussian(), random.gaussian(), random.gaussian()};
      odometry.push_back({i * 0.1, odometry.back().pose + step});
      truth.push_back({i * 0.1, truth.back().pose + step});
    }
    files::Trajectory subset{truth.front()};
    for (const files::StampedPose& p : truth)
      if (random.uniform() < 0.2) subset.push_back(p);
    const OdometryBridge bridge(subset, odometry, 0.006);
    for (const files::StampedPose& p : truth) {
      const auto point = bridge.poseAt(p.timestamp);
      ASSERT_TRUE(point.has_value());
      EXPECT_NEAR(std::hypot(point->pose.x - p.pose.x, point->pose.y - p.pose.y), 0, 1e-11);
      EXPECT_NEAR(std::cos(point->pose.phi - p.pose.phi), 1, 1e-12);
    }
  }
}

}  // namespace
}  // namespace hybrid_slam::evaluation
