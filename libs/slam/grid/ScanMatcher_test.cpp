#include "slam/grid/ScanMatcher.h"

#include <gtest/gtest.h>

#include "base/Degree.h"
#include "base/PoseOffset.h"
#include "testing/TestRoomGrid.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::math::TPose2D;

const OccupancyGrid& room() {
  static const OccupancyGrid grid = test::gridOf(kRoom);
  return grid;
}
const OccupancyGrid& corridor() {
  static const OccupancyGrid grid = test::gridOf(kCorridor);
  return grid;
}

ScanMatcher matcher(double sigma = 0.5) {
  ScanMatcherOptions options;
  options.sigma = sigma;
  return ScanMatcher(options);
}

Eigen::Matrix3d informationOf(const ScanBeams& scan, const TPose2D& pose, const OccupancyGrid& grid) {
  ScanLikelihood likelihood = matcher().likelihood(scan, grid);
  return scanInformation(likelihood, pose);
}

TPose2D somePose(RandomStream& random) {
  return {3 * random.uniform() - 1.5, 1.6 * random.uniform() - 0.8, 2 * M_PI * random.uniform() - M_PI};
}

TPose2D plus(const TPose2D& pose, const Eigen::Vector3d& step) {
  return {pose.x + step.x(), pose.y + step.y(), pose.phi + step.z()};
}

void expectNear(const TPose2D& pose, const TPose2D& expected, double distance, double angle) {
  const Eigen::Vector3d off = offsetOf(pose, expected);
  EXPECT_LT(off.head<2>().norm(), distance) << pose.asString() << " for " << expected.asString();
  EXPECT_LT(std::abs(off.z()), angle) << pose.asString() << " for " << expected.asString();
}

/// Central differences of f with respect to x, y and phi. The map is in single precision: with smaller steps
/// its rounding (1e-7 of each beam, over the step) shows.
template <class F>
Eigen::Vector3d differences(const F& f, const TPose2D& pose) {
  constexpr double kStep = 5e-5;
  Eigen::Vector3d gradient;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(k);
    gradient[k] = (f(plus(pose, step)) - f(plus(pose, -step))) / (2 * kStep);
  }
  return gradient;
}

/// m by the definition in the header: a beam's residual is 1 - m, and the scan has one beam.
double mapAt(const OccupancyGrid& grid, double x, double y) {
  ScanBeams point{LaserScan()};
  point.rays.push_back({1, 0, 0, 0});
  return 1 - std::sqrt(-2 * matcher(1).likelihood(point, grid).value({x, y, 0}));
}

TEST(ScanMatcher, TheMapIsTwoPMinusOneWhereItIsConstant) {
  for (const int value : {-50, 0, 1, 20, 55, 127}) {
    OccupancyGrid grid(0.05);
    for (int x = -40; x < 40; ++x)
      for (int y = -40; y < 40; ++y) grid.tiles().set({x, y}, static_cast<int8_t>(value));
    RandomStream random(1, 0, 0);
    const double expected = std::max(0.0, 2 / (1 + std::exp(-value / 16.0)) - 1);
    for (int i = 0; i < 100; ++i)
      EXPECT_NEAR(mapAt(grid, 3 * random.uniform() - 1.5, 3 * random.uniform() - 1.5), expected, 1e-6);
  }
}

TEST(ScanMatcher, AnOccupiedCellIsHighestAtItsMiddle) {
  OccupancyGrid grid(0.05);
  grid.tiles().set({7, -3}, 127);
  const double x = 7.5 * 0.05, y = -2.5 * 0.05, top = mapAt(grid, x, y);
  EXPECT_NEAR(top, 4.0 / 9 * std::tanh(127 / 32.0), 1e-6);  // the weight of the middle sample is 2/3 each way
  for (const double d : {0.02, 0.05, 0.08}) {
    EXPECT_LT(mapAt(grid, x + d, y), top);
    EXPECT_NEAR(mapAt(grid, x + d, y), mapAt(grid, x - d, y), 1e-9);
    EXPECT_NEAR(mapAt(grid, x, y + d), mapAt(grid, x - d, y), 1e-9);
  }
  EXPECT_NEAR(mapAt(grid, x + 0.1001, y), 0, 1e-12);
}

TEST(ScanMatcher, TheGradientMatchesTheValue) {
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const TPose2D truth = somePose(random);
    const ScanBeams scan = test::beamsAt(kRoom, truth, random);
    const TPose2D pose(truth.x + 0.05 * random.gaussian(), truth.y + 0.05 * random.gaussian(),
                       truth.phi + 0.03 * random.gaussian());
    const auto value = [&](const TPose2D& at) { return matcher().likelihood(scan, room()).value(at); };
    const LogDensity density = matcher().likelihood(scan, room())(pose);
    EXPECT_NEAR(density.value, value(pose), 1e-9 * std::abs(density.value));
    EXPECT_EQ(matcher().likelihood(scan, room()).gradient(pose), density.gradient);
    EXPECT_LT((density.gradient - differences(value, pose)).norm(), 1e-4 * density.gradient.norm() + 1e-2);
  }
}

/// For one beam the information is g g^T with g the gradient of m, and the likelihood's gradient (1 - m) g.
TEST(ScanMatcher, TheInformationOfABeamFollowsFromItsSlope) {
  RandomStream random(3, 0, 0);
  int sloped = 0;
  for (int i = 0; i < 300; ++i) {
    const TPose2D pose = somePose(random);
    ScanBeams scan = test::beamsAt(kRoom, pose, random);
    scan.rays = {scan.rays[static_cast<size_t>(i) % scan.rays.size()]};
    const LogDensity density = matcher(0.2).likelihood(scan, room())(pose);
    const double residual = std::sqrt(-2 * density.value) * 0.2;
    const Eigen::Vector3d slope = density.gradient * 0.2 * 0.2 / residual;
    EXPECT_LT((density.information * 0.2 * 0.2 - slope * slope.transpose()).norm(),
              1e-9 * (1 + density.information.norm()));
    sloped += slope.norm() > 1e-3;
  }
  EXPECT_GT(sloped, 100);
}

TEST(ScanMatcher, SigmaScalesTheLikelihood) {
  RandomStream random(4, 0, 0);
  const ScanBeams scan = test::beamsAt(kRoom, {}, random);
  const TPose2D pose(0.02, -0.03, 0.01);
  const LogDensity one = matcher(1).likelihood(scan, room())(pose);
  const LogDensity two = matcher(2).likelihood(scan, room())(pose);
  EXPECT_NEAR(two.value, one.value / 4, 1e-9);
  EXPECT_LT((two.gradient - one.gradient / 4).norm(), 1e-9);
  EXPECT_LT((two.information - one.information / 4).norm(), 1e-9);
}

TEST(ScanMatcher, AGaussianPriorHasItsDensity) {
  RandomStream random(5, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const TPose2D mean = somePose(random), pose = somePose(random);
    const Eigen::Matrix3d a = Eigen::Matrix3d::NullaryExpr([&] { return random.gaussian(); });
    const Eigen::Matrix3d information = a * a.transpose() + 0.1 * Eigen::Matrix3d::Identity();
    const LogDensity density = gaussianLogDensity(pose, mean, information);
    const Eigen::Vector3d off = offsetOf(pose, mean);
    EXPECT_NEAR(density.value, -0.5 * off.dot(information * off), 1e-9);
    EXPECT_EQ(density.information, information);
    if (std::abs(off.z()) > 3) continue;  // the angle wrap opposite to the mean
    const auto value = [&](const TPose2D& at) { return gaussianLogDensity(at, mean, information).value; };
    EXPECT_LT((density.gradient - differences(value, pose)).norm(), 1e-6 * (1 + density.gradient.norm()));
  }
}

/// The part of the basin from which, according to the header, all starts converge.
TEST(ScanMatcher, ReturnsFromDisplacedStarts) {
  RandomStream random(6, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const TPose2D truth = somePose(random);
    const ScanBeams scan = test::beamsAt(kRoom, truth, random);
    const double towards = 2 * M_PI * random.uniform(), sign = random.uniform() < 0.5 ? -1 : 1;
    const TPose2D start(truth.x + 0.05 * std::cos(towards), truth.y + 0.05 * std::sin(towards),
                        truth.phi + sign * 10 * random.uniform() * kDegree);
    const ScanMatch match = matcher().match(scan, start, room(), noPrior);
    expectNear(match.pose, truth, 0.02, 0.5 * kDegree);
    EXPECT_GT(match.fit, 0.5);
    EXPECT_GE(match.logPosterior, matcher().likelihood(scan, room()).value(start));
  }
}

TEST(ScanMatcher, TheBestNearPoseIsWhereAMatchReturnsFrom) {
  RandomStream random(7, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const TPose2D truth = somePose(random);
    const ScanBeams scan = test::beamsAt(kRoom, truth, random);
    ScanLikelihood likelihood = matcher().likelihood(scan, room());
    const double off = (random.uniform() < 0.5 ? -1 : 1) * (0.2 + 0.25 * random.uniform());
    const TPose2D start = truth + (i % 2 ? TPose2D(off, 0, 0) : TPose2D(0, off, 0));
    const auto found = bestNear(likelihood, start);
    ASSERT_TRUE(found) << i;
    expectNear(matcher().match(likelihood, *found, noPrior).pose, truth, 0.02, 0.5 * kDegree);
    EXPECT_FALSE(bestNear(likelihood, matcher().match(likelihood, truth, noPrior).pose)) << i;
  }
}

TEST(ScanMatcher, DegeneracyTellsACorridorFromARoom) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 10; ++i) {
    const TPose2D inCorridor(random.uniform(), 0.3 * random.uniform(), 6 * random.uniform());
    const ScanBeams along = test::beamsAt(kCorridor, inCorridor, random);
    EXPECT_LT(degeneracy(informationOf(along, inCorridor, corridor())), 0.02) << i;
    const TPose2D inRoom = somePose(random);
    const ScanBeams all = test::beamsAt(kRoom, inRoom, random);
    EXPECT_GT(degeneracy(informationOf(all, inRoom, room())), 0.05) << i;
  }
  EXPECT_EQ(degeneracy(Eigen::Matrix3d::Zero()), 0);
  EXPECT_NEAR(degeneracy(Eigen::Vector3d(1, 4, 2).asDiagonal()), 0.25, 1e-12);
}

TEST(ScanMatcher, AFeaturelessCorridorGivesNoInformationAlongIt) {
  RandomStream random(9, 0, 0);
  for (int i = 0; i < 50; ++i) {
    const TPose2D truth(2 * random.uniform() - 1, 0.4 * random.uniform() - 0.2, 6 * random.uniform() - 3);
    const ScanBeams scan = test::beamsAt(kCorridor, truth, random);
    // A prior of 1 m, which is weak compared with the information of the walls across.
    const Eigen::Matrix3d weak = Eigen::Matrix3d::Identity();
    const Prior prior = [&](const TPose2D& at) { return gaussianLogDensity(at, truth, weak); };
    const ScanMatch match = matcher().match(scan, truth, corridor(), prior);
    EXPECT_NEAR(match.pose.y, truth.y, 0.02);
    const Eigen::Matrix3d information = informationOf(scan, match.pose, corridor());
    EXPECT_LT(information(0, 0), 0.05 * information(1, 1)) << truth.asString();
  }
}

class NothingToMatch : public testing::TestWithParam<bool> {};

TEST_P(NothingToMatch, GivesBackThePrior) {
  RandomStream random(10, 0, 0);
  const ScanBeams scan = GetParam() ? ScanBeams(LaserScan()) : test::beamsAt(kRoom, {}, random);
  const OccupancyGrid grid = GetParam() ? room() : OccupancyGrid(0.05);
  const TPose2D mean(0.4, -0.3, 3.1);
  Eigen::Matrix3d information;
  information << 900, 100, -50, 100, 400, 30, -50, 30, 2000;
  const Prior prior = [&](const TPose2D& at) { return gaussianLogDensity(at, mean, information); };
  for (const TPose2D& start : {mean, TPose2D(0.6, -0.1, -3.1)}) {
    const ScanMatch match = matcher().match(scan, start, grid, prior);
    EXPECT_GT(prior(match.pose).value, -0.01);  // within 0.14 deviations
    EXPECT_EQ(informationOf(scan, match.pose, grid), Eigen::Matrix3d::Zero());
    EXPECT_EQ(match.fit, 0);
  }
  // A prior without information does not move the robot either.
  const ScanMatch still = matcher().match(scan, mean, grid, noPrior);
  EXPECT_EQ(still.pose, mean);
}

INSTANTIATE_TEST_SUITE_P(ScanMatcher, NothingToMatch, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "EmptyScan" : "EmptyGrid"; });

}  // namespace
}  // namespace hybrid_slam
