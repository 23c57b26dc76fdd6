#include "benchmarks/TrueLines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hybrid_slam::bench {
namespace {

using mrpt::DEG2RAD;
using simulation::BuildingPlan;
using simulation::Wall;
using testing::DoubleNear;
using testing::ElementsAre;

/// A scan of 181 beams over 180 deg.
LaserScan scan(double maxRange = 20) {
  LaserScan scan;
  scan.maxRange = maxRange;
  for (int i = -90; i <= 90; ++i) scan.beams.push_back({DEG2RAD(static_cast<double>(i)), 1, true});
  return scan;
}

/// A wall 4 m ahead of the robot at (0, 0).
const Wall kWall = Wall::straight({4, -3}, {4, 3});

/// A box that hides the `beams` beams around heading 0 from a robot at the origin.
Wall post(double beams) {
  const double half = 2 * std::tan(DEG2RAD(beams / 2));
  return Wall::straight({2, -half}, {2, half});
}

LineSegment segment(double x1, double y1, double x2, double y2) { return makeSegment({x1, y1}, {x2, y2}); }

TEST(TrueLines, AreWhatTheBeamsHit) {
  const auto lines = trueLines(BuildingPlan({kWall}), scan(), {});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].beams, 73u) << "-36 to 36 deg";
  EXPECT_NEAR(lines[0].segment.rho, 4, 1e-9);
  EXPECT_NEAR(lines[0].segment.length, 8 * std::tan(DEG2RAD(36.0)), 1e-9);
}

TEST(TrueLines, AreInTheFrameOfThePlan) {
  LaserScan turned = scan();
  turned.sensorPose = {0.5, 0, DEG2RAD(-90.0)};
  const auto lines = trueLines(BuildingPlan({kWall}), turned, {0, 0.5, DEG2RAD(90.0)});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].segment.rho, 4, 1e-9);
  EXPECT_NEAR(std::abs(std::remainder(lines[0].segment.theta, M_PI)), 0, 1e-9);
}

TEST(TrueLines, AThingInFrontOfAWallDividesItFromThreeBeamsOn) {
  EXPECT_EQ(trueLines(BuildingPlan({kWall, post(1.5)}), scan(), {}).size(), 2u) << "wall, post of 1 beam";
  const auto lines = trueLines(BuildingPlan({kWall, post(2.5)}), scan(), {});
  ASSERT_EQ(lines.size(), 3u);
  size_t ofWall = 0;
  for (const TrueLine& line : lines) ofWall += line.segment.rho > 3;
  EXPECT_EQ(ofWall, 2u);
}

TEST(TrueLines, NeitherArcsNorWallsOutOfRange) {
  EXPECT_TRUE(trueLines(BuildingPlan({kWall}), scan(3.9), {}).empty());
  EXPECT_TRUE(trueLines(BuildingPlan({Wall::arc({4, 0}, 1, 0, 2 * M_PI)}), scan(), {}).empty());
}

TEST(TrueLines, AgreementCountsFoundAndWrongLinesAndTheirErrors) {
  const std::vector<TrueLine> truth{{segment(4, -3, 4, 3), 70}, {segment(-3, 5, 3, 5), 70}};
  Agreement sum;
  sum.add({segment(4.05, -3, 4.05, 3),  // found, 5 cm off
           segment(4, -1, 4, 1),        // the same wall again: wrong
           segment(-3, 5.2, 3, 5.2),    // too far off
           segment(-3, 5 - 3 * std::tan(DEG2RAD(6.0)), 3, 5 + 3 * std::tan(DEG2RAD(6.0)))},  // turned too far
          truth, 0.5, 10);
  EXPECT_EQ(sum.trueLines, 2u);
  EXPECT_EQ(sum.found, 1u);
  EXPECT_EQ(sum.wrong, 3u);
  EXPECT_THAT(sum.distances, ElementsAre(DoubleNear(0.05, 1e-9)));
  EXPECT_THAT(sum.angles, ElementsAre(DoubleNear(0, 1e-9)));
  const double turn = DEG2RAD(2.0);
  sum.add({segment(-3, 5 - 3 * std::tan(turn), 3, 5 + 3 * std::tan(turn))}, truth, 0.5, 10);
  EXPECT_EQ(sum.trueLines, 4u);
  EXPECT_EQ(sum.found, 2u);
  EXPECT_THAT(sum.angles, ElementsAre(DoubleNear(0, 1e-9), DoubleNear(turn, 1e-9)));
}

TEST(TrueLines, OverlapByHalfOfTheShorterIsNeeded) {
  const std::vector<TrueLine> truth{{segment(4, 0, 4, 2), 70}};
  Agreement most, least;
  most.add({segment(4, 0.9, 4, 2.9)}, truth, 0.5, 10);
  least.add({segment(4, 1.1, 4, 3.1)}, truth, 0.5, 10);
  EXPECT_EQ(most.found, 1u);
  EXPECT_EQ(least.found, 0u);
  EXPECT_EQ(least.wrong, 1u);
}

TEST(TrueLines, APieceThatIsNoLineCountsNeitherWay) {
  for (const TrueLine& piece : {TrueLine{segment(4, 0, 4, 0.3), 70}, TrueLine{segment(4, 0, 4, 2), 5}}) {
    Agreement sum;
    sum.add({piece.segment}, {piece}, 0.5, 10);
    EXPECT_EQ(sum.trueLines, 0u);
    EXPECT_EQ(sum.found, 0u);
    EXPECT_EQ(sum.wrong, 0u);
  }
}

}  // namespace
}  // namespace hybrid_slam::bench
