#include "slam/grid/NarrowThings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/Degree.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

/// Beams 2 deg apart at a wall 5 m ahead; a box of `width` m stands `range` m ahead, `bearing` (rad) to the
/// left.
ScanBeams beamsAt(double width, double range, double bearing = 0, double stepDeg = 2) {
  LaserScan scan;
  for (double angle = -45 * kDegree; angle < 45 * kDegree + 1e-9; angle += stepDeg * kDegree) {
    const double across = range * std::tan(angle - bearing);
    const bool isBox = std::abs(across) <= width / 2;
    scan.beams.push_back({angle, isBox ? range / std::cos(angle - bearing) : 5 / std::cos(angle), true});
  }
  return ScanBeams(scan);
}

size_t narrowOf(const ScanBeams& beams) {
  const std::vector<bool> all = endsAtNarrowThing(beams);
  EXPECT_EQ(all.size(), beams.rays.size());
  return static_cast<size_t>(std::count(all.begin(), all.end(), true));
}

TEST(NarrowThings, APersonIsNarrowAndACupboardIsNot) {
  for (const double range : {1.0, 2.0, 3.5})
    for (const double bearing : {-0.5, 0.0, 0.4}) {
      EXPECT_GT(narrowOf(beamsAt(0.4, range, bearing)), 2u) << range << " " << bearing;
      EXPECT_EQ(narrowOf(beamsAt(1.0, range, bearing)), 0u) << range << " " << bearing;
    }
}

TEST(NarrowThings, AWallIsNoneHoweverFarItsBeamsAreApart) {
  for (const double step : {0.25, 1.0, 2.0, 4.0, 8.0})
    EXPECT_EQ(narrowOf(beamsAt(0, 1, 0, step)), 0u) << step;
}

TEST(NarrowThings, WhatIsSeenThroughAGapIsBehind) {
  LaserScan scan;  // a wall at 2 m with a gap, through which a piece of a wall at 6 m is seen
  for (int i = -20; i <= 20; ++i) scan.beams.push_back({2 * i * kDegree, std::abs(i) <= 1 ? 6.0 : 2.0, true});
  EXPECT_EQ(narrowOf(ScanBeams(scan)), 0u);
}

/// Someone stands 3 m ahead of the robot, in a map made without or with him.
struct Met {
  explicit Met(bool isMapped, double width = 0.4) : seen(beamsAt(width, 3)) {
    const ScanBeams mapped = beamsAt(isMapped ? width : 0, 3, 0, 0.25);
    for (int i = 0; i < 40; ++i) map.insert(mapped, {}, GridOptions());
  }
  size_t movedOf(const TPose2D& robot = {}) const {
    const std::vector<bool> moved = endsAtMovedThing(seen, robot, map);
    return static_cast<size_t>(std::count(moved.begin(), moved.end(), true));
  }
  ScanBeams seen;
  OccupancyGrid map;
};

TEST(NarrowThings, WhereTheMapIsFreeAPersonHasMoved) {
  const Met person(false);
  EXPECT_EQ(person.movedOf(), narrowOf(person.seen));
  EXPECT_GT(person.movedOf(), 2u);
  EXPECT_EQ(Met(false, 1.0).movedOf(), 0u) << "a board is evidence against the map";
}

TEST(NarrowThings, AMappedPillarHasNotMovedIfThePoseIsRightWithinTwoCells) {
  const Met pillar(true);
  EXPECT_EQ(pillar.movedOf(), 0u);
  EXPECT_EQ(pillar.movedOf({0.1, 0, 0}), 0u);
  EXPECT_GT(pillar.movedOf({-0.4, 0, 0}), 2u) << "the pose is wrong";
}

TEST(NarrowThings, InUnknownSpaceNothingHasMoved) {
  Met person(false);
  person.map = OccupancyGrid();
  EXPECT_EQ(person.movedOf(), 0u);
}

TEST(NarrowThings, LeavesOutValidBeamsOnly) {
  LaserScan scan;
  for (int i = 0; i < 4; ++i) scan.beams.push_back({0.1 * i, 1, i != 1});
  const LaserScans still = without({scan, scan}, {false, true, false, true, false, false});
  const auto isValid = [&still](size_t laser, size_t i) { return still[laser].beams[i].valid; };
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(isValid(0, i), i == 0 || i == 3) << i;
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(isValid(1, i), i == 2 || i == 3) << i;
}

TEST(NarrowThings, BeamsOfTwoLasersAreNotNeighbours) {
  LaserScan scan;  // two lasers end at the same wall
  for (int i = 0; i < 30; ++i) scan.beams.push_back({i * kDegree, 3, true});
  LaserScan other = scan;
  other.beams.resize(2);
  EXPECT_EQ(narrowOf(ScanBeams(LaserScans{scan, other})), 0u);
  EXPECT_EQ(narrowOf(ScanBeams()), 0u);
}

}  // namespace
}  // namespace hybrid_slam
