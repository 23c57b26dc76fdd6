#include "slam/filter/PathRelaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/PoseDistance.h"
#include "testing/RingDrive.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// A lap around the ring and a corridor more.
struct Lap {
  std::vector<TPose2D> path, odometry, truth;
  std::vector<Scans> scans;
};

/// The path drifts by `drift` per metre; when the robot is back, the scans draw it over `drawn` m to the
/// walls at the beginning. After that, every `displaced`-th scan (0: none) is one of 0.15 m ahead.
Lap lapThatDrifts(const TPose2D& drift, size_t displaced = 0, double drawn = 3) {
  constexpr double kBack = 100;  // m
  Lap lap;
  double distance = 0;
  for (const DrivenPose& step : ringDrive(0)) {
    distance += step.motion.norm();
    const double error = std::min(distance, kBack) * std::clamp(1 - (distance - kBack) / drawn, 0.0, 1.0);
    lap.path.push_back(TPose2D(error * drift.x, error * drift.y, error * drift.phi) + step.truth);
    lap.odometry.push_back(step.motion);
    lap.truth.push_back(step.truth);
    RandomStream random(1, lap.path.size(), 0);
    const bool isDisplaced = distance > kBack + drawn && displaced > 0 && lap.path.size() % displaced == 0;
    lap.scans.push_back(observed(
        isDisplaced ? scanOf(ring(), step.truth + TPose2D(0.15, 0, 0), {0.2, 0, 0}, 181, M_PI, 0.01, random)
                    : step.scans[0]));
  }
  return lap;
}

/// RMS distance from the truth, m.
double error(const std::vector<TPose2D>& path, const Lap& lap) {
  double squares = 0;
  for (size_t i = 0; i < path.size(); ++i)
    squares += std::pow(path[i].x - lap.truth[i].x, 2) + std::pow(path[i].y - lap.truth[i].y, 2);
  return std::sqrt(squares / static_cast<double>(path.size()));
}

std::vector<TPose2D> relaxed(const Lap& lap) {
  return hybrid_slam::relaxed(lap.path, lap.odometry, lap.scans, FilterConfiguration());
}

TEST(PathRelaxation, DistributesTheErrorOfALapOverTheLap) {
  for (const TPose2D& drift :
       {TPose2D(0.001, 0, 0), TPose2D(0, 0.001, 0), TPose2D(-0.0007, 0.0007, 0), TPose2D(0, -0.002, 0)}) {
    const Lap lap = lapThatDrifts(drift);
    EXPECT_LT(error(relaxed(lap), lap), 0.7 * error(lap.path, lap)) << drift.asString();
  }
}

TEST(PathRelaxation, ATruePathStaysNearTheTruth) {
  const Lap lap = lapThatDrifts({});
  EXPECT_LT(error(relaxed(lap), lap), 0.03);
}

TEST(PathRelaxation, APathInOneRoomStaysNearTheTruth) {
  Lap lap;
  for (const DriveStep& step : drive(8)) {
    lap.odometry.push_back(lap.path.empty() ? TPose2D() : step.truth - lap.path.back());
    lap.path.push_back(step.truth), lap.truth.push_back(step.truth);
    lap.scans.push_back({mrpt::obs::CObservation2DRangeScan::Create(step.scan)});
  }
  EXPECT_LT(error(relaxed(lap), lap), 0.02);
}

TEST(PathRelaxation, APathThatDoesNotReturnStays) {
  Lap lap = lapThatDrifts({0.001, 0, 0});
  lap.path.resize(300), lap.scans.resize(300);
  EXPECT_EQ(relaxed(lap), lap.path);
  EXPECT_TRUE(relaxed(Lap()).empty());
}

TEST(PathRelaxation, MatchesThatDisagreeLoseWeight) {
  const Lap lap = lapThatDrifts({0.001, 0, 0}, 4);
  EXPECT_LT(error(relaxed(lap), lap), 0.4 * error(lap.path, lap));
}

/// A true lap, but when the robot is back in the first corridor, the path jumps by `off` m along it.
Lap lapThatJumps(double off) {
  constexpr double kBack = 110;  // m
  Lap lap = lapThatDrifts({});
  const std::vector<double> distances = lengthsAlong(lap.truth);
  for (size_t i = 0; i < lap.path.size(); ++i)
    if (distances[i] > kBack) lap.path[i].x += off;
  return lap;
}

TEST(PathRelaxation, AStretchOfReturnsAtAWrongPlaceIsMoved) {
  for (const double off : {0.4, -0.4}) {
    const Lap lap = lapThatJumps(off);
    EXPECT_GT(error(lap.path, lap), 0.15);
    EXPECT_LT(error(relaxed(lap), lap), 0.05) << off;
  }
}

/// The largest error of a motion (m).
double largestJump(const std::vector<TPose2D>& path, const Lap& lap) {
  double largest = 0;
  for (size_t i = 1; i < path.size(); ++i) {
    const TPose2D moved = path[i] - path[i - 1], truly = lap.truth[i] - lap.truth[i - 1];
    largest = std::max(largest, std::hypot(moved.x - truly.x, moved.y - truly.y));
  }
  return largest;
}

TEST(PathRelaxation, AJumpToTheOldWallsIsDistributed) {
  for (const TPose2D& drift : {TPose2D(0.005, 0, 0), TPose2D(0, -0.004, 0)}) {
    const Lap lap = lapThatDrifts(drift, 0, 0.01);
    EXPECT_GT(largestJump(lap.path, lap), 0.35);
    EXPECT_LT(largestJump(relaxed(lap), lap), 0.05) << drift.asString();
    EXPECT_LT(error(relaxed(lap), lap), 0.7 * error(lap.path, lap)) << drift.asString();
  }
}

TEST(PathRelaxation, AMotionThatTheOdometryMissedStays) {
  Lap lap = lapThatDrifts({});
  const auto slip = [&lap](size_t i, const TPose2D& by) { lap.odometry[i] = lap.odometry[i] + by; };
  slip(lap.path.size() / 2, {0.3, 0.2, 15 * kDegree});
  slip(lap.path.size() / 3, {-0.4, 0, 0});
  EXPECT_LT(error(relaxed(lap), lap), 0.03);
}

// A corridor shows no motion along it, so the odometry fits as well as the path.
TEST(PathRelaxation, AMotionAlongABareCorridorStaysAsThePathHasIt) {
  const Walls walls = box(-60, -1.5, 100, 1.5);
  Lap lap;
  for (const DrivenPose& step : driveAlong(walls, {{0, 0}, {40, 0}, {10, 0}}, 0)) {
    lap.path.push_back(step.truth), lap.truth.push_back(step.truth);
    lap.odometry.push_back(step.motion);
    lap.scans.push_back(observed(step.scans[0]));
  }
  const double without = error(relaxed(lap), lap);
  EXPECT_LT(without, 0.15);
  lap.odometry[80] = lap.odometry[80] + TPose2D(0.5, 0, 0);
  EXPECT_NEAR(error(relaxed(lap), lap), without, 0.03);
}

TEST(PathRelaxation, AMotionThatTheOdometryMissedInATurnStays) {
  Lap lap = lapThatDrifts({});
  for (const size_t i : {size_t(100), lap.path.size() - 60})
    lap.odometry[i] = lap.odometry[i] + TPose2D(0, 0, (i == 100 ? 10 : -60) * kDegree);
  EXPECT_LT(error(relaxed(lap), lap), 0.03);
}

// The new place is not in the map of the latest scans.
TEST(PathRelaxation, ARobotThatWasCarriedIsNotTakenBack) {
  for (const auto& [first, last] : {std::pair(150, 270), std::pair(30, 80)}) {  // round a corner; ahead
    Lap lap = lapThatDrifts({});
    const auto carried = [first = first, last = last](auto& values) {
      values.erase(values.begin() + first, values.begin() + last);
    };
    carried(lap.path), carried(lap.odometry), carried(lap.truth), carried(lap.scans);
    EXPECT_GT((lap.truth[first] - lap.truth[first - 1]).norm(), 10);
    EXPECT_LT(error(relaxed(lap), lap), 0.03) << first;
  }
}

TEST(PathRelaxation, TheFirstPoseIsFixedAndThreadsDoNotMatter) {
  const Lap lap = lapThatDrifts({0, 0.001, 0});
  FilterConfiguration two;
  two.filter.threads = 2;
  const auto path = relaxed(lap);
  EXPECT_EQ(path.front(), lap.path.front());
  EXPECT_EQ(hybrid_slam::relaxed(lap.path, lap.odometry, lap.scans, two), path);
}

TEST(PathRelaxation, PosesWithoutScansKeepTheirMotions) {
  Lap lap = lapThatDrifts({0.001, 0, 0});
  const size_t known = lap.path.size() - 40;
  lap.scans.resize(known);
  const auto path = relaxed(lap);
  ASSERT_EQ(path.size(), lap.path.size());
  EXPECT_NE(path[known - 1], lap.path[known - 1]);
  const TPose2D moved = path.back() - path[known - 1], before = lap.path.back() - lap.path[known - 1];
  EXPECT_NEAR(moved.x, before.x, 1e-9);
  EXPECT_NEAR(moved.y, before.y, 1e-9);
  EXPECT_NEAR(moved.phi, before.phi, 1e-9);
}

}  // namespace
}  // namespace hybrid_slam
