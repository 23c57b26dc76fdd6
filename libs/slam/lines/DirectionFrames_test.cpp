#include "slam/lines/DirectionFrames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/Degree.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/WallDirections.h"

namespace hybrid_slam {
namespace {

std::vector<DatabaseLine> linesAt(const std::vector<double>& degrees, double length = 6) {
  std::vector<DatabaseLine> lines;
  for (const double direction : degrees) {
    DatabaseLine line;
    line.theta = direction * kDegree, line.direction = wrapToRightAngle(line.theta);
    line.length = length;
    lines.push_back(line);
  }
  return lines;
}

TEST(DirectionFrames, NoneWithoutLines) { EXPECT_TRUE(directionFrames({}).empty()); }

TEST(DirectionFrames, TwoLinesAreAFrame) {
  EXPECT_TRUE(directionFrames(linesAt({100})).empty());
  const auto frames = directionFrames(linesAt({100, 10}));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_NEAR(frames[0].direction, 10 * kDegree, 1e-12);
  EXPECT_EQ(frames[0].lines, 2);
  EXPECT_DOUBLE_EQ(frames[0].evidence, 12);
}

TEST(DirectionFrames, ABuildingWithAWing) {
  auto lines = linesAt({0.1, 90.1, 179.9, -0.1, 30, 120.2, 120.1});
  lines[0].count = 5;
  const auto frames = directionFrames(lines);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_NEAR(frames[0].direction, 0.05 * kDegree, 1e-9);  // (5 x 0.1 + 0.1 - 0.1 - 0.1) / 8
  EXPECT_NEAR(frames[1].direction, 30.1 * kDegree, 1e-9);
  EXPECT_EQ(frames[0].lines, 4);
  EXPECT_EQ(frames[1].lines, 3);
}

/// Directions about the wrap at 45 deg are one frame.
TEST(DirectionFrames, AcrossTheWrap) {
  const auto frames = directionFrames(linesAt({44.9, 45.1, 134.8, -44.8, 0, 0, 0}));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].lines, 4);
  EXPECT_NEAR(std::abs(rightAngleDifference(frames[0].direction, 45 * kDegree)), 0, 1e-9);
}

TEST(DirectionFrames, AnOddLineIsNoFrame) {
  std::vector<double> degrees(19, 12);
  degrees.push_back(40);
  const auto frames = directionFrames(linesAt(degrees));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].lines, 19);
}

/// Lines at random angles support no direction, apart from a few by chance.
TEST(DirectionFrames, FewInClutter) {
  size_t frames = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> angle(0, 180);
    std::vector<double> degrees(20);
    for (double& d : degrees) d = angle(random);
    frames += directionFrames(linesAt(degrees)).size();
  }
  EXPECT_LE(frames, 10u);
}

/// Turning the map turns the frames.
TEST(DirectionFrames, TurnWithTheMap) {
  for (int turn = -90; turn <= 90; turn += 7) {
    std::vector<double> degrees{1.0, 91.2, 1.1, 41.0, 131.1, 41.0, 131.0};
    for (double& d : degrees) d += turn;
    const auto frames = directionFrames(linesAt(degrees));
    ASSERT_EQ(frames.size(), 2u) << turn;
    const auto off = [&](size_t i, double expected) {
      return rightAngleDifference(frames[i].direction, wrapToRightAngle((expected + turn) * kDegree));
    };
    EXPECT_NEAR(off(0, 41.025), 0, 1e-9);
    EXPECT_NEAR(off(1, 1.1), 0, 1e-9);
  }
}

}  // namespace
}  // namespace hybrid_slam
