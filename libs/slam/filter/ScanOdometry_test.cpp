#include "slam/filter/ScanOdometry.h"

#include <gtest/gtest.h>

#include "testing/RoomLog.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

/// Returns the estimate after each of these true poses, relative to the first.
std::vector<TPose2D> tracked(const std::vector<TPose2D>& truth) {
  ScanOdometry odometry{GridOptions(), ScanMatcherOptions()};
  std::vector<TPose2D> poses;
  for (const TPose2D& pose : truth)
    poses.push_back((poses.empty() ? TPose2D() : poses.back()) +
                    odometry.motionTo({test::scan(1, pose)}, static_cast<double>(poses.size())));
  return poses;
}

void expectTracked(const std::vector<TPose2D>& truth) {
  const std::vector<TPose2D> poses = tracked(truth);
  for (size_t i = 0; i < truth.size(); ++i) {
    const TPose2D error = poses[i] - (truth[i] - truth[0]);
    EXPECT_LT(error.norm(), 0.1) << i;
    EXPECT_LT(std::abs(error.phi), 0.03) << i;
  }
}

TEST(ScanOdometry, ALap) {
  std::vector<TPose2D> lap;
  for (size_t i = 0; i < 80; ++i) lap.push_back(test::poseOnLap(i, 80));
  expectTracked(lap);
}

/// Jerks of 50 deg are out of reach of the search, unless the turn is measured.
TEST(ScanOdometry, AMeasuredTurnIsThePrediction) {
  const auto errorOf = [](bool isMeasured) {
    ScanOdometry odometry{GridOptions(), ScanMatcherOptions()};
    TPose2D pose, before, truth;
    for (int i = 0; i < 12; ++i) {
      truth = {0.5, 0.2, i % 4 == 0 ? 0 : i % 2 == 0 ? 0.9 : -0.9};
      const std::optional<double> turn =
          isMeasured ? std::optional(1.03 * (truth - before).phi) : std::nullopt;
      pose = pose + odometry.motionTo({test::scan(1, truth)}, i, i == 0 ? std::nullopt : turn);
      if (i == 0) pose = truth;
      before = truth;
    }
    return std::abs((pose - truth).phi);
  };
  EXPECT_LT(errorOf(true), 0.03);
  EXPECT_GT(errorOf(false), 0.3);
}

/// Every tenth scan has no returns, and four in succession: the map is kept, and the robot found again.
TEST(ScanOdometry, ScansWithoutReturns) {
  ScanOdometry odometry{GridOptions(), ScanMatcherOptions()};
  const TPose2D start = test::poseOnLap(0, 160);
  TPose2D pose;
  for (size_t i = 0; i < 160; ++i) {
    const TPose2D truth = test::poseOnLap(i, 160);
    const auto seen = test::scan(1, truth);
    const bool isBlank = i % 10 == 7 || (60 <= i && i < 64);
    if (isBlank)
      for (size_t k = 0; k < seen->getScanSize(); ++k) seen->setScanRangeValidity(k, false);
    pose = pose + odometry.motionTo({seen}, static_cast<double>(i));
    const TPose2D error = pose - (truth - start);
    EXPECT_LT(error.norm(), isBlank ? 0.5 : 0.1) << i;
  }
}

TEST(ScanOdometry, ARobotThatStopsAndStarts) {
  std::vector<TPose2D> poses;
  for (size_t i = 0; i < 20; ++i)
    for (size_t k = 0; k < (i % 5 == 0 ? 5 : 1); ++k) poses.push_back(test::poseOnLap(2 * i, 80));
  expectTracked(poses);
}

TEST(ScanOdometry, AStandingRobotDoesNotDrift) {
  const auto poses = tracked(std::vector<TPose2D>(50, test::poseOnLap(7, 80)));
  EXPECT_LT(poses.back().norm(), 0.02);
}

/// Without beams the prediction remains.
TEST(ScanOdometry, AShorterStepIsPredictedInProportionALongerOneIsNot) {
  const auto predicted = [](double duration) {
    ScanOdometry odometry{GridOptions(), ScanMatcherOptions()};
    TPose2D last;
    for (int i = 0; i < 10; ++i)
      last = odometry.motionTo({test::scan(1, test::poseOnLap(static_cast<size_t>(i), 80))}, i);
    const auto blind = test::scan(1);
    for (size_t k = 0; k < blind->getScanSize(); ++k) blind->setScanRangeValidity(k, false);
    return odometry.motionTo({blind}, 9 + duration).norm() / last.norm();
  };
  EXPECT_NEAR(predicted(0.5), 0.5, 1e-6);
  EXPECT_NEAR(predicted(5), 1, 1e-6);
  EXPECT_NEAR(predicted(-1), 1, 1e-6) << "timestamps step back";
}

TEST(ScanOdometry, GoesOnAfterScansWithoutReturns) {
  ScanOdometry odometry{GridOptions(), ScanMatcherOptions()};
  const auto blind = test::scan(1);
  for (size_t i = 0; i < blind->getScanSize(); ++i) blind->setScanRangeValidity(i, false);
  for (size_t i = 0; i < 10; ++i)
    odometry.motionTo({test::scan(1, test::poseOnLap(i, 80))}, static_cast<double>(i));
  const double first = odometry.motionTo({blind}, 10).norm();
  EXPECT_LT(first, 0.2) << "the prediction";
  EXPECT_NEAR(odometry.motionTo({blind}, 11).norm(), first / 2, 1e-9) << "slowing down";
  odometry.motionTo({test::scan(1, test::poseOnLap(20, 80))}, 12);
  const TPose2D truth = test::poseOnLap(21, 80) - test::poseOnLap(20, 80);
  EXPECT_LT((odometry.motionTo({test::scan(1, test::poseOnLap(21, 80))}, 13) - truth).norm(), 0.05);
}

}  // namespace
}  // namespace hybrid_slam
