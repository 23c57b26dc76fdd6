#include "run/TrajectoryRecorder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;

void expectPoses(const files::Trajectory& trajectory, const std::vector<TPose2D>& expected) {
  ASSERT_EQ(trajectory.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(trajectory[i].timestamp, 10 + static_cast<double>(i));
    EXPECT_NEAR(trajectory[i].pose.x, expected[i].x, 1e-12);
    EXPECT_NEAR(trajectory[i].pose.y, expected[i].y, 1e-12);
    EXPECT_NEAR(std::remainder(trajectory[i].pose.phi - expected[i].phi, 2 * M_PI), 0, 1e-12);
  }
}

/// Records scans at 10 s, 11 s, ..., each 1 m ahead of the previous one, with the number of `updates` after
/// each.
TrajectoryRecorder straight(const std::vector<size_t>& updates) {
  TrajectoryRecorder recorder;
  for (size_t i = 0; i < updates.size(); ++i)
    recorder.add(10 + static_cast<double>(i), {i == 0 ? 0. : 1., 0, 0}, updates[i]);
  return recorder;
}

TEST(TrajectoryRecorder, UpdatesHaveTheFiltersOwnPoses) {
  expectPoses(straight({1, 2, 3}).trajectory({{5, 1, 0.1}, {6, 2, 0.2}, {8, 3, -3}}),
              {{5, 1, 0.1}, {6, 2, 0.2}, {8, 3, -3}});
}

TEST(TrajectoryRecorder, BetweenTwoUpdatesTheClosingErrorIsSpreadEvenly) {
  // Odometry says 4 m ahead; the filter 4.4 m ahead, 0.8 m to the left and turned by 0.4 rad.
  expectPoses(straight({1, 1, 1, 1, 2}).trajectory({{0, 0, 0}, {4.4, 0.8, 0.4}}),
              {{0, 0, 0}, {1.1, 0.2, 0.1}, {2.2, 0.4, 0.2}, {3.3, 0.6, 0.3}, {4.4, 0.8, 0.4}});
}

/// A robot stands for eight scans, then moves by 1 m, with an error of 0.4 m.
TEST(TrajectoryRecorder, AStandingRobotDoesNotSlide) {
  TrajectoryRecorder recorder;
  for (int i = 0; i < 9; ++i) recorder.add(10 + i, {}, 1);
  recorder.add(19, {0.5, 0, 0}, 1);
  recorder.add(20, {0.5, 0, 0}, 2);
  std::vector<TPose2D> expected(9);
  expected.insert(expected.end(), {{0.7, 0, 0}, {1.4, 0, 0}});
  expectPoses(recorder.trajectory({{0, 0, 0}, {1.4, 0, 0}}), expected);
}

TEST(TrajectoryRecorder, TheOdometryBetweenIsInTheFrameOfThePreviousUpdate) {
  expectPoses(straight({1, 1, 2}).trajectory({{3, 3, M_PI / 2}, {3, 5, M_PI / 2}}),
              {{3, 3, M_PI / 2}, {3, 4, M_PI / 2}, {3, 5, M_PI / 2}});
}

TEST(TrajectoryRecorder, GivesTheOdometryBetweenTheScans) {
  TrajectoryRecorder recorder;
  EXPECT_TRUE(recorder.motions().empty());
  const std::vector<TPose2D> motions{{0.5, 0.1, 0.2}, {1, 0, -0.4}};
  recorder.add(10, {7, 7, 7}, 1);  // before the first scan: no motion between two
  for (const TPose2D& motion : motions) recorder.add(11, motion, 1);
  const auto given = recorder.motions();
  ASSERT_EQ(given.size(), motions.size());
  for (size_t i = 0; i < motions.size(); ++i)
    EXPECT_LT((given[i] - motions[i]).norm() + std::abs(given[i].phi - motions[i].phi), 1e-9) << i;
}

TEST(TrajectoryRecorder, GivesTheOdometryBetweenTheUpdates) {
  TrajectoryRecorder recorder;
  EXPECT_TRUE(recorder.motionsOfUpdates().empty());
  recorder.add(9, {3, 3, 3}, 0);  // before the first update
  for (const size_t updates : {1, 1, 1, 2, 3, 3}) recorder.add(10, {0.5, 0, 0.1}, updates);
  const auto given = recorder.motionsOfUpdates();
  const TPose2D step(0.5, 0, 0.1);
  const std::vector<TPose2D> expected{{}, step + step + step, step};
  ASSERT_EQ(given.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT((given[i] - expected[i]).norm() + std::abs(given[i].phi - expected[i].phi), 1e-9) << i;
}

TEST(TrajectoryRecorder, HeadingErrorsAreSpreadTheShorterWay) {
  TrajectoryRecorder recorder;
  recorder.add(10, {}, 1);
  recorder.add(11, {}, 1);
  recorder.add(12, {}, 2);
  expectPoses(recorder.trajectory({{0, 0, M_PI - 0.1}, {0, 0, -M_PI + 0.1}}),
              {{0, 0, M_PI - 0.1}, {0, 0, M_PI}, {0, 0, -M_PI + 0.1}});
}

TEST(TrajectoryRecorder, BeforeTheFirstAndAfterTheLastUpdateOnlyOdometryIsUsed) {
  expectPoses(straight({0, 0, 1, 1, 2, 2, 2}).trajectory({{0, 0, 0}, {2, 1, M_PI / 2}}), {{-2, 0, 0},
                                                                                          {-1, 0, 0},
                                                                                          {0, 0, 0},
                                                                                          {1, 0.5, M_PI / 4},
                                                                                          {2, 1, M_PI / 2},
                                                                                          {2, 2, M_PI / 2},
                                                                                          {2, 3, M_PI / 2}});
}

TEST(TrajectoryRecorder, WithoutAnyUpdateItIsTheOdometry) {
  expectPoses(straight({0, 0, 0}).trajectory({}), {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_TRUE(TrajectoryRecorder().trajectory({}).empty());
}

TEST(TrajectoryRecorder, OdometryIsChainedInTheRobotsFrame) {
  TrajectoryRecorder recorder;
  recorder.add(10, {}, 1);
  for (size_t i = 1; i < 4; ++i) recorder.add(10 + static_cast<double>(i), {1, 0, M_PI / 2}, 1);
  expectPoses(recorder.trajectory({{0, 0, 0}}),
              {{0, 0, 0}, {1, 0, M_PI / 2}, {1, 1, M_PI}, {0, 1, -M_PI / 2}});
  EXPECT_DOUBLE_EQ(recorder.distance(), 3);
}

}  // namespace
}  // namespace hybrid_slam::run
