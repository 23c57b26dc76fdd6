#include "slam/filter/LineMapWeight.h"

#include <gtest/gtest.h>

#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

std::vector<DatabaseLine> linesOf(const Walls& walls) {
  std::vector<DatabaseLine> lines;
  for (const auto& [start, end] : walls) lines.push_back({makeSegment(start, end), 1, 0, 0});
  return lines;
}

/// One beam from the robot's centre.
ScanBeams beam(double angle, double range) {
  ScanBeams beams;
  beams.origins = {{0, 0}};
  beams.rays = {{std::cos(angle), std::sin(angle), range, 0}};
  return beams;
}

double likelihood(double angle, double range, const Walls& walls, const LineMapOptions& options) {
  return std::exp(
      LineMapWeight(options, 20).meanLogLikelihood(beam(angle, range), {}, LineDatabase(linesOf(walls))));
}

TEST(LineMapWeight, BeamsMeetTheNearestLine) {
  RandomStream random(1, 0, 0);
  for (int k = 0; k < 200; ++k) {
    Walls walls;
    for (int i = 0; i < 12; ++i) {
      const LineSegment line = randomSegment(random, 10);
      walls.emplace_back(line.start, line.end);
    }
    const TPose2D robot = randomPose(random, 5), sensor(0.3, -0.2, 0.7);
    const LaserScan scan = scanOf(walls, robot, sensor, 61, 2 * M_PI, 0, random);
    ScanBeams beams(scan);
    const std::vector<ExpectedWall> expected = expectedWalls(beams, robot, linesOf(walls), 20);
    ASSERT_EQ(expected.size(), beams.rays.size());
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(expected[i].range, beams.rays[i].range, 1e-6);
  }
}

TEST(LineMapWeight, LinesOutOfReachAreLeftOut) {
  const Walls ahead{{{15, -20}, {15, 20}}}, aside{{{2, 17}, {2, 30}}};
  const auto rangeTo = [](const Walls& walls, double angle, double reach) {
    return expectedWalls(beam(angle, 1), {}, linesOf(walls), reach)[0].range;
  };
  EXPECT_NEAR(rangeTo(ahead, 0, 16), 15, 1e-9);
  EXPECT_TRUE(std::isinf(rangeTo(ahead, 0, 14)));
  EXPECT_TRUE(std::isinf(rangeTo(aside, std::atan2(18, 2), 14)));
  EXPECT_NEAR(rangeTo(aside, std::atan2(18, 2), 20), std::hypot(18, 2), 1e-9);
}

TEST(LineMapWeight, SineOfTheAngleOfIncidence) {
  const auto walls = expectedWalls(beam(30 * kDegree, 1), {}, linesOf({{{3, -9}, {3, 9}}}), 20);
  EXPECT_NEAR(walls[0].range, 3 / std::cos(30 * kDegree), 1e-9);
  EXPECT_NEAR(walls[0].sine, std::cos(30 * kDegree), 1e-9);
}

TEST(LineMapWeight, TheFormula) {
  LineMapOptions o;
  o.sigma = 0.1, o.inFront = 0.2, o.random = 0.05;
  const Walls wall{{{4, -9}, {4, 9}}};
  const double c = o.sigma * std::sqrt(2 * M_PI), anywhere = c * o.random / 20;
  EXPECT_NEAR(likelihood(0, 4, wall, o), 0.75 + anywhere, 1e-12);
  EXPECT_NEAR(likelihood(0, 4.1, wall, o), 0.75 * std::exp(-0.5) + anywhere, 1e-12);
  EXPECT_NEAR(likelihood(0, 2, wall, o), c * o.inFront / 4 + anywhere, 1e-12);
  EXPECT_NEAR(likelihood(0, 6, wall, o), anywhere, 1e-12);
  EXPECT_NEAR(likelihood(M_PI, 4, wall, o), c / 20, 1e-12);  // no line there
  // The distance is that from the line, not along the beam.
  EXPECT_NEAR(likelihood(60 * kDegree, 8.2, wall, o), 0.75 * std::exp(-0.5) + anywhere, 1e-9);
}

TEST(LineMapWeight, TheTruePoseHasTheGreatestWeight) {
  const Walls walls = polygon({{-3, -2}, {5, -2}, {5, 4}, {-3, 4}});
  const LineDatabase lines(linesOf(walls));
  RandomStream random(1, 0, 0);
  const ScanBeams beams(scanOf(walls, {}, {0.2, 0, 0}, 181, M_PI, 0.01, random));
  const LineMapWeight weight(LineMapOptions(), 20);
  const double best = weight.meanLogLikelihood(beams, {}, lines);
  EXPECT_LE(best, 0);
  for (const double sign : {-1, 1})
    for (const TPose2D& off : {TPose2D(0.05, 0, 0), TPose2D(0, 0.05, 0), TPose2D(0, 0, kDegree)})
      EXPECT_LT(weight.meanLogLikelihood(beams, {sign * off.x, sign * off.y, sign * off.phi}, lines), best);
}

TEST(LineMapWeight, NothingToCompare) {
  const LineMapWeight weight(LineMapOptions(), 20);
  EXPECT_EQ(weight.meanLogLikelihood(ScanBeams(), {}, LineDatabase(linesOf({{{1, -1}, {1, 1}}}))), 0);
  const double empty = weight.meanLogLikelihood(beam(0, 3), {}, LineDatabase());
  EXPECT_EQ(weight.meanLogLikelihood(beam(2, 9), {1, 2, 3}, LineDatabase()), empty);
  EXPECT_TRUE(std::isfinite(empty));
  const LineDatabase point(linesOf({{{2, 0}, {2, 0}}}));  // a line of no length
  EXPECT_EQ(weight.meanLogLikelihood(beam(0, 3), {}, point), empty);
}

}  // namespace
}  // namespace hybrid_slam
