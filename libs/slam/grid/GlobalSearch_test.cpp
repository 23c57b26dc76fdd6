#include "slam/grid/GlobalSearch.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>

#include "testing/TestScans.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// A room in which no two places look alike.
const Walls kSearchedRoom = polygon({{-3, -2.5}, {8, -2.5}, {8, 6}, {3, 6}, {3, 5}, {1, 5}, {1, 6}, {-3, 6}});

LaserScan scanAt(const TPose2D& robot, RandomStream& random) {
  return scanOf(kSearchedRoom, robot, {0.2, 0, 0}, 181, M_PI, 0.01, random);
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

bool contains(const std::vector<GlobalSearch::Place>& places, const TPose2D& robot) {
  return std::any_of(places.begin(), places.end(),
                     [&](const auto& place) { return isNear(place.pose, robot); });
}

TEST(GlobalSearch, FindsThePoseAmongTheBest) {
  const GlobalSearch search(mappedRoom(), {});
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const TPose2D robot(uniform(random, -2, 6), uniform(random, -1.5, 4), uniform(random, -M_PI, M_PI));
    const ScanBeams scan(scanAt(robot, random));
    EXPECT_TRUE(contains(search(scan, {}, 20), robot)) << robot.asString();
    const double heading = robot.phi + 3 * kDegree;
    EXPECT_TRUE(contains(search(scan, {heading, heading + M_PI / 2}, 20), robot)) << robot.asString();
  }
}

TEST(GlobalSearch, IsBoundedOnAMapOfKilometres) {
  OccupancyGrid grid = mappedRoom();
  grid.tiles().set({400000, 400000}, 77);  // 20 km away
  RandomStream random(5, 0, 0);
  const TPose2D robot(1, 2, 0.5);
  const ScanBeams scan(scanAt(robot, random));
  EXPECT_TRUE(contains(GlobalSearch(grid, {100, 100})(scan, {}, 20), robot));
  EXPECT_TRUE(GlobalSearch(grid, {600, 0})(scan, {}, 20).empty());
}

TEST(GlobalSearch, FindsNothingWithoutAMapOrAScan) {
  RandomStream random(3, 0, 0);
  EXPECT_TRUE(GlobalSearch(OccupancyGrid(), {})(ScanBeams(scanAt({}, random)), {}, 20).empty());
  EXPECT_TRUE(GlobalSearch(mappedRoom(), {})(ScanBeams(LaserScan()), {}, 20).empty());
}

TEST(BeamShares, AgreeAtTheTruePoseAndContradictElsewhere) {
  const OccupancyGrid grid = mappedRoom();
  RandomStream random(4, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const TPose2D robot(uniform(random, -2, 6), uniform(random, -1.5, 4), uniform(random, -M_PI, M_PI));
    const ScanBeams scan(scanAt(robot, random));
    EXPECT_LT(beamShares(scan, robot, grid).contradicted, 0.05) << robot.asString();
    EXPECT_GT(beamShares(scan, robot + TPose2D(0, 0, 100 * kDegree), grid).contradicted, 0.3)
        << robot.asString();
    EXPECT_GT(beamShares(scan, robot, grid).explained, 0.9) << robot.asString();
    EXPECT_EQ(beamShares(scan, robot, OccupancyGrid()).contradicted, 0);
    EXPECT_EQ(beamShares(scan, robot, OccupancyGrid()).explained, 0);
  }
}

}  // namespace
}  // namespace hybrid_slam
