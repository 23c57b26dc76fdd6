#include "slam/filter/RecentMap.h"

#include <gtest/gtest.h>

#include "slam/grid/GlobalSearch.h"
#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// The scans of a robot that drove `steps` steps from the origin through the room.
class Driven {
 public:
  explicit Driven(int steps) {
    for (int i = 0; i < steps; ++i) {
      path.push({0.1 * i, 0, 0.02 * i});
      recent.add(scanAt(path.back()));
    }
  }
  ScanBeams scanAt(const TPose2D& robot) { return prepared(room(), robot, random_).matchedBeams; }
  Path path;
  RecentMap recent{GridOptions()};

 private:
  RandomStream random_{1, 0, 0};
};

TEST(RecentMap, ExplainsTheNextScanButNoneFromElsewhere) {
  Driven robot(20);
  const TPose2D next(2, 0, 0.4);
  const ScanBeams scan = robot.scanAt(next);
  const BeamShares shares = beamShares(scan, next, robot.recent.map(robot.path, 0));
  EXPECT_GT(shares.explained, 0.9);
  EXPECT_LT(shares.contradicted, 0.05);
  const BeamShares elsewhere = beamShares(robot.scanAt({5, 2, 2}), next, robot.recent.map(robot.path, 0));
  EXPECT_LT(elsewhere.explained, 0.5);
  EXPECT_GT(elsewhere.contradicted, 0.1);
}

/// The robot was carried before the newest three scans.
TEST(RecentMap, LeavesOutTheNewestScans) {
  Driven robot(20);
  const TPose2D carriedTo(5, 2, 2), believed(2, 0, 0.4);
  const ScanBeams scan = robot.scanAt(carriedTo);
  for (int i = 0; i < 3; ++i) {
    robot.path.push(believed);
    robot.recent.add(scan);
  }
  EXPECT_GT(beamShares(scan, believed, robot.recent.map(robot.path, 0)).explained, 0.8);
  EXPECT_LT(beamShares(scan, believed, robot.recent.map(robot.path, 3)).explained, 0.5);
}

TEST(RecentMap, KnowsNothingWithoutScans) {
  Driven robot(20);
  const TPose2D next(2, 0, 0.4);
  const ScanBeams scan = robot.scanAt(next);
  EXPECT_EQ(beamShares(scan, next, robot.recent.map(robot.path, 20)).explained, 0);
  EXPECT_EQ(beamShares(scan, next, robot.recent.map(robot.path, 30)).explained, 0);
  robot.recent.clear();
  EXPECT_EQ(beamShares(scan, next, robot.recent.map(robot.path, 0)).explained, 0);
}

/// Only the newest 40 scans count: the path may have drifted since the others.
TEST(RecentMap, ForgetsTheOldest) {
  Driven robot(20);
  const TPose2D beginning(0, 0, 0);
  const ScanBeams scan = robot.scanAt(beginning);
  ASSERT_GT(beamShares(scan, beginning, robot.recent.map(robot.path, 0)).explained, 0.8);
  const Walls elsewhere = polygon({{30, 30}, {34, 30}, {34, 33}, {30, 33}});
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 40; ++i) {
    robot.path.push({32, 31.5, 0.1 * i});
    robot.recent.add(prepared(elsewhere, robot.path.back(), random).matchedBeams);
  }
  EXPECT_EQ(beamShares(scan, beginning, robot.recent.map(robot.path, 0)).explained, 0);
}

}  // namespace
}  // namespace hybrid_slam
