#include "slam/grid/GlobalSearch.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>

#include "testing/TestScans.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// No two places of it look alike.
const Walls kRoom = polygon({{-3, -2.5}, {8, -2.5}, {8, 6}, {3, 6}, {3, 5}, {1, 5}, {1, 6}, {-3, 6}});

LaserScan scanAt(const TPose2D& robot, RandomStream& random) {
  return scanOf(kRoom, robot, {0.2, 0, 0}, 181, M_PI, 0.01, random);
}

OccupancyGrid mappedRoom() {
  OccupancyGrid grid;
  RandomStream random(1, 0, 0);
  for (const double x : {-1.0, 1.0, 3.0, 5.0})
    for (const double y : {-1.0, 1.0, 3.0, 4.0})
      for (const double phi : {0.0, 2.0, 4.0})
        grid.insert(ScanBeams(scanAt({x, y, phi}, random)), {x, y, phi}, GridOptions());
  return grid;
}

bool isNear(const TPose2D& a, const TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y) < 0.3 &&
         std::abs(mrpt::math::wrapToPi(a.phi - b.phi)) < 4 * kDegree;
}

TEST(GlobalSearch, FindsThePoseAmongTheBest) {
  const OccupancyGrid grid = mappedRoom();
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const TPose2D robot(uniform(random, -2, 6), uniform(random, -1.5, 4), uniform(random, -M_PI, M_PI));
    const ScanBeams scan(scanAt(robot, random));
    const auto everywhere = globalSearch(scan, grid, {}, {}, 20);
    EXPECT_TRUE(std::any_of(everywhere.begin(), everywhere.end(), [&](const TPose2D& pose) {
      return isNear(pose, robot);
    })) << robot.asString();
    const double heading = robot.phi + 3 * kDegree;
    const auto aligned = globalSearch(scan, grid, {}, {heading, heading + M_PI / 2}, 20);
    EXPECT_TRUE(std::any_of(aligned.begin(), aligned.end(), [&](const TPose2D& pose) {
      return isNear(pose, robot);
    })) << robot.asString();
  }
}

TEST(GlobalSearch, IsBoundedOnAMapOfKilometres) {
  OccupancyGrid grid = mappedRoom();
  grid.tiles().set({400000, 400000}, 77);  // 20 km away
  RandomStream random(5, 0, 0);
  const TPose2D robot(1, 2, 0.5);
  const auto near = globalSearch(ScanBeams(scanAt(robot, random)), grid, {100, 100}, {}, 20);
  EXPECT_TRUE(std::any_of(near.begin(), near.end(), [&](const TPose2D& p) { return isNear(p, robot); }));
  EXPECT_TRUE(globalSearch(ScanBeams(scanAt(robot, random)), grid, {600, 0}, {}, 20).empty());
}

TEST(GlobalSearch, FindsNothingWithoutAMapOrAScan) {
  RandomStream random(3, 0, 0);
  EXPECT_TRUE(globalSearch(ScanBeams(scanAt({}, random)), OccupancyGrid(), {}, {}, 20).empty());
  EXPECT_LE(globalSearch(ScanBeams(LaserScan()), mappedRoom(), {}, {}, 20).size(), 20u);
}

TEST(ContradictedShare, IsSmallAtTheTruePoseAndLargeElsewhere) {
  const OccupancyGrid grid = mappedRoom();
  RandomStream random(4, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const TPose2D robot(uniform(random, -2, 6), uniform(random, -1.5, 4), uniform(random, -M_PI, M_PI));
    const ScanBeams scan(scanAt(robot, random));
    EXPECT_LT(contradictedShare(scan, robot, grid), 0.05) << robot.asString();
    EXPECT_GT(contradictedShare(scan, robot + TPose2D(0, 0, 100 * kDegree), grid), 0.3) << robot.asString();
    EXPECT_EQ(contradictedShare(scan, robot, OccupancyGrid()), 0);
  }
}

}  // namespace
}  // namespace hybrid_slam
