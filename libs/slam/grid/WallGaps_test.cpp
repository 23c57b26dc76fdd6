#include "slam/grid/WallGaps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {
namespace {

constexpr double kDegree = M_PI / 180;

/// Beams 2 deg apart, from -10 to 10 deg, at a wall across x = 5 m; noise by `off` (m) of the middle one.
LaserScan facingWall(double off = 0) {
  LaserScan scan;
  for (int i = -5; i <= 5; ++i) {
    const double angle = 2 * i * kDegree;
    scan.beams.push_back({angle, (i == 0 ? 5 + off : 5) / std::cos(angle), true});
  }
  return scan;
}

std::vector<size_t> gapsOf(const LaserScan& scan, double longest = 1) {
  return wallGaps(ScanBeams(scan), longest);
}

TEST(WallGaps, AreBetweenTheBeamsOfOneWall) {
  EXPECT_THAT(gapsOf(facingWall()), testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(gapsOf(facingWall(0.02)), testing::SizeIs(8)) << "noise of a laser";
}

TEST(WallGaps, AreAtMostSoLong) { EXPECT_THAT(gapsOf(facingWall(), 0.17), testing::IsEmpty()); }

// The points beside one that is off the wall may not be on one line with it.
TEST(WallGaps, AreNotBesideAPointOffTheWall) {
  EXPECT_THAT(gapsOf(facingWall(0.1)), testing::ElementsAre(1, 2, 7, 8));
}

TEST(WallGaps, AreNotWhereABeamHasNoReturn) {
  LaserScan scan = facingWall();
  scan.beams[5].valid = false;
  // Beams 4 and 6 are rays 4 and 5 now.
  EXPECT_THAT(gapsOf(scan),
              testing::AllOf(testing::Contains(2), testing::Not(testing::Contains(4)), testing::Contains(6)));
}

TEST(WallGaps, AreNotAcrossACorner) {
  LaserScan scan;
  for (int i = 0; i < 20; ++i) {  // walls along y at x = 3 m and along x at y = 2 m
    const double angle = (20 + 2 * i) * kDegree;
    scan.beams.push_back({angle, std::min(3 / std::cos(angle), 2 / std::sin(angle)), true});
  }
  const ScanBeams beams(scan);
  const auto ends = beams.endPoints();
  const std::vector<size_t> gaps = wallGaps(beams, 1);
  EXPECT_GT(gaps.size(), 10u);
  for (const size_t i : gaps) EXPECT_EQ(ends[i].y > 1.99, ends[i + 1].y > 1.99) << i;
}

// The second laser goes on 0.2 m beside where the first ends.
TEST(WallGaps, AreNotBetweenTwoLasers) {
  const LaserScan one = facingWall();
  LaserScan beside = one;
  beside.sensorPose.y = 2 * 5 * std::tan(10 * kDegree) + 0.2;
  EXPECT_THAT(wallGaps(ScanBeams(LaserScans{one, beside}), 1),
              testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 15, 16, 17, 18, 19));
}

// A wall seen at a grazing angle, with end points up to 0.9 m apart: every cell of it is hit.
TEST(WallGaps, AreHitOnTheGrid) {
  LaserScan scan;
  for (int i = 10; i <= 60; ++i) {
    const double angle = i * kDegree;
    scan.beams.push_back({angle, 1.22 / std::sin(angle), true});
  }
  GridOptions options;
  const auto hits = [&] {
    OccupancyGrid grid;
    grid.insert(ScanBeams(scan), {}, options);
    int count = 0;
    for (int x = 20; x < 115; ++x) count += grid.occupancy({x, 24}) > 0.5;  // 1 to 5.75 m
    return count;
  };
  EXPECT_EQ(hits(), 95);
  options.wallGap = 0;
  EXPECT_LT(hits(), 40);
}

}  // namespace
}  // namespace hybrid_slam
