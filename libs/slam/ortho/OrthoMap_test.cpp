#include "slam/ortho/OrthoMap.h"

#include <gtest/gtest.h>

#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// The four walls of a room as a robot in it sees them.
std::vector<LineSegment> roomFrom(const TPose2D& robot) {
  std::vector<LineSegment> lines;
  for (const auto& [start, end] : polygon({{-3, -2}, {5, -2}, {5, 4}, {-3, 4}}))
    lines.push_back(transformed(makeSegment(start, end), TPose2D() - robot));
  return lines;
}

OrthoMap map() { return {OrthoOptions(), LineDatabaseOptions()}; }

TEST(OrthoMap, ARoomHasFourLines) {
  OrthoMap room = map();
  room.update(roomFrom({}));
  EXPECT_NEAR(room.direction().value(), 0, 1e-9);
  const auto lines = room.lines();
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_NEAR(lines[0].start.y, -2, 1e-9);
  EXPECT_NEAR(lines[0].length, 8, 1e-9);
  EXPECT_NEAR(lines[1].start.x, 5, 1e-9);
  EXPECT_EQ(room.matched(), 0);
  room.update(roomFrom({}));
  EXPECT_EQ(room.lines().size(), 4u);
  EXPECT_EQ(room.lines()[0].count, 2);
  EXPECT_EQ(room.matched(), 4);
}

/// The robot starts at the origin of the map, the building is turned.
TEST(OrthoMap, ATurnedBuilding) {
  OrthoMap room = map();
  const TPose2D start(1, 0.5, -30 * kDegree);
  room.update(roomFrom(start));
  EXPECT_NEAR(room.direction().value(), 30 * kDegree, 1e-9);
  EXPECT_NEAR(room.pose().norm(), 0, 1e-9);
  EXPECT_NEAR(room.pose().phi, 0, 1e-9);
  const LineSegment expected = roomFrom(start)[0];
  EXPECT_NEAR(lineDistance(room.lines()[0].rho, room.lines()[0].theta, expected.rho, expected.theta), 0,
              1e-9);
}

/// The odometry is 3 deg and 20 cm off: heading and position come from the walls.
TEST(OrthoMap, CorrectsTurnAndPosition) {
  MotionModelOptions motion;
  OrthoOptions options;
  options.sigmaAngle = 0.01 * kDegree;
  options.sigmaOffset = 0.001;
  OrthoMap room(options, LineDatabaseOptions());
  room.update(roomFrom({}));
  const TPose2D truth(1, 0.5, 80 * kDegree);
  room.move({1.15, 0.35, 83 * kDegree}, motion);
  room.update(roomFrom(truth));
  EXPECT_EQ(room.matched(), 4);
  EXPECT_NEAR(room.pose().phi, truth.phi, 0.01 * kDegree);
  EXPECT_NEAR(room.pose().x, truth.x, 0.005);
  EXPECT_NEAR(room.pose().y, truth.y, 0.005);
  EXPECT_LT(std::sqrt(room.poseCovariance()(0, 0)), 0.005);
}

/// The position along a corridor, which no line determines, stays uncertain.
TEST(OrthoMap, ACorridorSaysNothingAlongIt) {
  OrthoMap corridor = map();
  const std::vector<LineSegment> walls{makeSegment(TPoint2D(-9, 1), TPoint2D(9, 1)),
                                       makeSegment(TPoint2D(-9, -1), TPoint2D(9, -1))};
  corridor.update(walls);
  corridor.move({2, 0, 0}, MotionModelOptions());
  const double before = corridor.poseCovariance()(0, 0);
  corridor.update(walls);
  EXPECT_NEAR(corridor.poseCovariance()(0, 0), before, 0.01 * before);
  EXPECT_LT(corridor.poseCovariance()(1, 1), 0.4 * before);
}

TEST(OrthoMap, WithoutLinesTheOdometryAlone) {
  OrthoMap nothing = map();
  TPose2D odometry;
  for (int i = 0; i < 50; ++i) {
    const TPose2D motion(0.1, 0, 3 * kDegree);
    odometry = odometry + motion;
    nothing.move(motion, MotionModelOptions());
    nothing.update({});
  }
  EXPECT_FALSE(nothing.direction());
  EXPECT_TRUE(nothing.lines().empty());
  EXPECT_NEAR((nothing.pose() - odometry).norm(), 0, 1e-9);
  EXPECT_GT(nothing.poseCovariance()(0, 0), 0.001);
  nothing.update(roomFrom(odometry));  // the frame is found later
  EXPECT_NEAR(nothing.direction().value(), 0, 1e-6);
  EXPECT_NEAR((nothing.pose() - odometry).norm(), 0, 1e-6);
  EXPECT_EQ(nothing.lines().size(), 4u);
}

TEST(OrthoMap, LinesAtOtherAnglesAreIgnored) {
  OrthoMap room = map();
  room.update(roomFrom({}));
  std::vector<LineSegment> seen = roomFrom({});
  seen.push_back(makeSegment(TPoint2D(3, 0), TPoint2D(4, 1)));
  room.update(seen);
  EXPECT_EQ(room.lines().size(), 4u);
  EXPECT_NEAR(room.pose().phi, 0, 1e-6);
}

TEST(OrthoMap, PiecesOfAWallAreJoinedWhenTheyMeet) {
  const auto wall = [](double from, double to) {
    return std::vector<LineSegment>{makeSegment(TPoint2D(from, 2), TPoint2D(to, 2))};
  };
  OrthoMap room = map();
  room.update(wall(0, 3));
  room.update(wall(6, 9));
  ASSERT_EQ(room.lines().size(), 2u);
  room.update(wall(2, 7));
  ASSERT_EQ(room.lines().size(), 1u);
  EXPECT_NEAR(room.lines()[0].length, 9, 0.01);
  EXPECT_EQ(room.lines()[0].count, 3);
}

TEST(OrthoMap, LinesNotSeenAgainArePruned) {
  OrthoMap room = map();
  std::vector<LineSegment> seen = roomFrom({});
  seen.push_back(makeSegment(TPoint2D(1, 1), TPoint2D(3, 1)));
  room.update(seen);
  EXPECT_EQ(room.lines().size(), 5u);
  for (int i = 0; i < 20; ++i) room.update(roomFrom({}));
  EXPECT_EQ(room.lines().size(), 4u);
}

}  // namespace
}  // namespace hybrid_slam
