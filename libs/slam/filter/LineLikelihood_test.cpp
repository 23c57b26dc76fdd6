#include "slam/filter/LineLikelihood.h"

#include <gtest/gtest.h>

#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

const TPose2D kLineStart(0.4, 0.3, 0.5);

LineLikelihoodOptions optionsOf(const FilterConfiguration& c) {
  return {c.lineWeight, c.association, c.database.minCount, c.improved};
}

PreparedScan scanAt(const TPose2D& robot) {
  RandomStream random(2, 0, 0);
  return test::prepared(test::room(), robot, random);
}

/// A database of the walls x = 2 and y = 3 that were seen `count` times.
LineDatabase cornerOf(int count) {
  LineDatabase database;
  for (int i = 0; i < count; ++i)
    database.update({makeSegment({2, -3}, {2, 3}), makeSegment({-3, 3}, {2, 3})}, LineDatabaseOptions(),
                    AssociationOptions());
  return database;
}

/// The wall x = 2 as a robot at `pose` sees it, 2 m long.
std::vector<LineSegment> wallFrom(const TPose2D& pose) {
  return {transformed(makeSegment({2, -1}, {2, 1}), TPose2D() - pose)};
}

TEST(LineLikelihood, AKnownWallGivesTheSquaredAngleAndDistance) {
  FilterConfiguration c;
  const LineDatabase database = cornerOf(c.database.minCount);
  const TPose2D truth(0.3, 0.2, 0.4);
  const auto seen = wallFrom(truth);
  const LineLikelihood lines(seen, truth, database, optionsOf(c));
  const double perAngle = std::pow(c.improved.lineSigma, -2),
               perDistance = std::pow(c.improved.lineSigmaRho, -2);
  EXPECT_NEAR(lines(truth).value, 0, 1e-12);
  EXPECT_NEAR(lines({truth.x + 0.05, truth.y, truth.phi}).value, -0.5 * 0.05 * 0.05 * perDistance, 1e-9);
  EXPECT_NEAR(lines({truth.x, truth.y + 0.05, truth.phi}).value, 0, 1e-9);  // along the wall
  // Turning by d moves the wall's middle, which lies at (1.7, -0.2) from the robot.
  const double d = 0.001, off = 1.7 * std::cos(d) + 0.2 * std::sin(d) - 1.7;
  EXPECT_NEAR(lines({truth.x, truth.y, truth.phi + d}).value,
              -0.5 * (d * d * perAngle + off * off * perDistance), 1e-9);
  EXPECT_NEAR(lines({truth.x + 0.4, truth.y, truth.phi}).value, -4.5, 1e-9);  // another wall
}

TEST(LineLikelihood, ARarelySeenWallIsComparedWithTheDirections) {
  FilterConfiguration c;
  const LineDatabase database = cornerOf(c.database.minCount - 1);
  const TPose2D truth(0.3, 0.2, 0.4);
  const auto seen = wallFrom(truth);
  const LineLikelihood lines(seen, truth, database, optionsOf(c));
  const double d = 0.5 * c.improved.lineSigma;
  EXPECT_NEAR(lines({truth.x + 0.1, truth.y, truth.phi + d}).value,
              -0.5 * std::pow(d / c.improved.lineSigma, 2), 1e-9);
}

TEST(LineLikelihood, NoLinesAreNeutral) {
  const LineDatabase database = cornerOf(9);
  const std::vector<LineSegment> none;
  const LogDensity density = LineLikelihood(none, {}, database, optionsOf(FilterConfiguration()))({1, 2, 3});
  EXPECT_EQ(density.value, 0);
  EXPECT_EQ(density.gradient, Eigen::Vector3d::Zero());
  EXPECT_EQ(density.information, Eigen::Matrix3d::Zero());
}

TEST(LineLikelihood, TheGradientMatchesTheValue) {
  const Particle particle = test::particleAt(test::room(), kLineStart);
  const PreparedScan scan = scanAt(kLineStart);
  FilterConfiguration c;
  c.improved.lineSigma = 3 * kDegree;
  RandomStream random(7, 0, 0);
  for (const int minCount : {1, 1000}) {  // all walls are known, or none
    c.database.minCount = minCount;
    const LineLikelihood lines(scan.lines, kLineStart, *particle.lines, optionsOf(c));
    int sloped = 0;
    for (int i = 0; i < 200; ++i) {
      const TPose2D pose(kLineStart.x + 0.03 * random.gaussian(), kLineStart.y + 0.03 * random.gaussian(),
                         kLineStart.phi + 0.02 * random.gaussian());
      const LogDensity density = lines(pose);
      constexpr double kStep = 1e-6;
      const double dx =
          lines({pose.x + kStep, pose.y, pose.phi}).value - lines({pose.x - kStep, pose.y, pose.phi}).value;
      const double dy =
          lines({pose.x, pose.y + kStep, pose.phi}).value - lines({pose.x, pose.y - kStep, pose.phi}).value;
      const double dphi =
          lines({pose.x, pose.y, pose.phi + kStep}).value - lines({pose.x, pose.y, pose.phi - kStep}).value;
      const Eigen::Vector3d differences = Eigen::Vector3d(dx, dy, dphi) / (2 * kStep);
      if (differences.norm() > 1e5) continue;  // across the edge of what is still the same wall
      EXPECT_LT((density.gradient - differences).norm(), 1e-4 * (1 + density.gradient.norm()));
      sloped += density.gradient.norm() > 0;
    }
    EXPECT_GT(sloped, 100);
  }
}

TEST(LineLogDensity, IsTheLogarithmOfTheWeightWithItsGradient) {
  const Particle particle = test::particleAt(test::room(), kLineStart);
  const PreparedScan scan = scanAt(kLineStart);
  ASSERT_TRUE(particle.lines->dominatingDirection());
  RandomStream random(7, 0, 0);
  LineWeightOptions options;
  int sloped = 0;
  for (int i = 0; i < 500; ++i) {
    const double heading = kLineStart.phi + 0.06 * random.gaussian();
    const auto ln = [&](double at) {
      return std::log(lineWeight(scan.lines, at, *particle.lines, options).value);
    };
    const LogDensity density = lineLogDensity(scan.lines, heading, *particle.lines, options);
    EXPECT_EQ(density.value, ln(heading));
    EXPECT_EQ(density.gradient.x(), 0);
    EXPECT_EQ(density.gradient.y(), 0);
    EXPECT_GE(density.information(2, 2), 0);
    const double below = ln(heading - 1e-6), above = ln(heading + 1e-6), floor = std::log(options.floor);
    if ((below == floor) != (above == floor)) continue;  // the edge of the floor has no slope
    EXPECT_NEAR(density.gradient.z(), (above - below) / 2e-6, 1e-4 * (1 + std::abs(density.gradient.z())));
    sloped += density.gradient.z() != 0;
  }
  EXPECT_GT(sloped, 100);
}

TEST(LineLogDensity, EqNinesStepsHaveNoSlope) {
  const Particle particle = test::particleAt(test::room(), kLineStart);
  const PreparedScan scan = scanAt(kLineStart);
  LineWeightOptions options;
  options.method = LineWeightOptions::Method::paper;
  const LogDensity density = lineLogDensity(scan.lines, kLineStart.phi + 0.2, *particle.lines, options);
  EXPECT_EQ(density.value,
            std::log(lineWeight(scan.lines, kLineStart.phi + 0.2, *particle.lines, options).value));
  EXPECT_EQ(density.gradient, Eigen::Vector3d::Zero());
  EXPECT_EQ(density.information, Eigen::Matrix3d::Zero());
}

}  // namespace
}  // namespace hybrid_slam
