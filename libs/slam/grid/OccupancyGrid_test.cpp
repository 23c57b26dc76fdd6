#include "slam/grid/OccupancyGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/Errors.h"
#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

// Log-odds in steps of 1/16: 16 ln(0.7 / 0.3) = 13.56, 16 ln(0.4 / 0.6) = -6.49, 16 ln(0.97 / 0.03) = 55.6.
constexpr int kHit = 14, kMiss = -6, kHighest = 56, kLowest = -56;

/// The update parameters of the figures above.
GridOptions update() {
  GridOptions options;
  options.pHit = 0.7, options.pMiss = 0.4;
  options.wallGap = 0;
  return options;
}

struct Reading {
  double angle, range;
};

ScanBeams beams(const std::vector<Reading>& readings, const TPose2D& sensor = {}) {
  LaserScan scan;
  scan.sensorPose = sensor;
  for (const Reading& r : readings) scan.beams.push_back({r.angle, r.range, true});
  return ScanBeams(scan);
}

/// Cells [x0, x1] of row y.
std::vector<int> row(const OccupancyGrid& grid, int x0, int x1, int y) {
  std::vector<int> values;
  for (int x = x0; x <= x1; ++x) values.push_back(grid.tiles().at({x, y}));
  return values;
}

TEST(OccupancyGrid, OneBeamMissesTheCellsItCrossesAndHitsTheOneItEndsIn) {
  OccupancyGrid grid(1);
  grid.insert(beams({{0, 4.2}}), {0.5, 0.5, 0}, update());
  EXPECT_EQ(row(grid, -1, 6, 0), (std::vector<int>{0, kMiss, kMiss, kMiss, kMiss, kHit, 0, 0}));
  EXPECT_EQ(row(grid, -1, 6, 1), std::vector<int>(8, 0));
  EXPECT_EQ(row(grid, -1, 6, -1), std::vector<int>(8, 0));
}

TEST(OccupancyGrid, OneHitMeansPHitAndOneMissPMiss) {
  OccupancyGrid grid(1);
  grid.insert(beams({{0, 2}}), {0.5, 0.5, 0}, update());
  const double step = OccupancyGrid::kLogOddsScale / 2 / 4;  // half a step of the log-odds: dp = p (1 - p) dl
  EXPECT_NEAR(grid.occupancy({2, 0}), 0.7, step);
  EXPECT_NEAR(grid.occupancy({1, 0}), 0.4, step);
  EXPECT_EQ(grid.occupancy({7, 7}), 0.5);
}

TEST(OccupancyGrid, ACellHitIsHitOnceAndNotMissedByAnotherBeamOfTheScan) {
  OccupancyGrid grid(1);
  grid.insert(beams({{0, 3}, {0, 3}, {0, 6}}), {0.5, 0.5, 0}, update());
  EXPECT_EQ(row(grid, 0, 7, 0),
            (std::vector<int>{3 * kMiss, 3 * kMiss, 3 * kMiss, kHit, kMiss, kMiss, kHit, 0}));
}

TEST(OccupancyGrid, TheNextScanMayMissIt) {
  OccupancyGrid grid(1);
  grid.insert(beams({{0, 3}}), {0.5, 0.5, 0}, update());
  grid.insert(beams({{0, 6}}), {0.5, 0.5, 0}, update());
  EXPECT_EQ(grid.tiles().at({3, 0}), kHit + kMiss);
}

TEST(OccupancyGrid, StaysBetweenPMinAndPMaxAndCanChange) {
  OccupancyGrid grid(1);
  for (int i = 0; i < 100; ++i) grid.insert(beams({{0, 3}}), {0.5, 0.5, 0}, update());
  EXPECT_EQ(row(grid, 0, 4, 0), (std::vector<int>{kLowest, kLowest, kLowest, kHighest, 0}));
  for (int i = 0; i < 100; ++i) grid.insert(beams({{0, 4}}), {0.5, 0.5, 0}, update());
  EXPECT_EQ(row(grid, 0, 5, 0), (std::vector<int>{kLowest, kLowest, kLowest, kLowest, kHighest, 0}));
}

TEST(OccupancyGrid, TheExtremeOptionsFitIntoACell) {
  OccupancyGrid grid(1);
  GridOptions options;
  options.pHit = 0.99, options.pMiss = 0.01, options.pMin = 0.001, options.pMax = 0.999;
  for (int i = 0; i < 10; ++i) grid.insert(beams({{0, 3}}), {0.5, 0.5, 0}, options);
  EXPECT_NEAR(grid.occupancy({3, 0}), 0.999, 1e-4);
  EXPECT_NEAR(grid.occupancy({1, 0}), 0.001, 1e-4);
}

TEST(OccupancyGrid, TheSensorPoseIsApplied) {
  // Robot at (2, 3.5) looking along y, sensor 1 m ahead and 0.5 m to the left, turned to the left: the beam
  // starts at (1.5, 4.5) and runs 3 m along -x.
  OccupancyGrid grid(1);
  grid.insert(beams({{0, 3}}, {1, 0.5, M_PI / 2}), {2, 3.5, M_PI / 2}, update());
  EXPECT_EQ(row(grid, -3, 2, 4), (std::vector<int>{0, kHit, kMiss, kMiss, kMiss, 0}));
}

TEST(OccupancyGrid, ADiagonalBeamSkipsCellsThatItOnlyTouches) {
  OccupancyGrid grid(1);
  ScanBeams diagonal = beams({{0, 3 * M_SQRT2}});
  diagonal.rays[0].dirX = diagonal.rays[0].dirY = M_SQRT1_2;  // equal to the last bit
  grid.insert(diagonal, {0.5, 0.5, 0}, update());
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x)
      EXPECT_EQ(grid.tiles().at({x, y}), x != y ? 0 : x < 3 ? kMiss : x == 3 ? kHit : 0) << x << " " << y;
}

TEST(OccupancyGrid, InvalidBeamsAndEmptyScansLeaveItAsItIs) {
  LaserScan scan;
  scan.beams = {{0, 3, false}, {1, 0, false}};
  OccupancyGrid grid(1);
  grid.insert(ScanBeams(scan), {}, update());
  grid.insert(ScanBeams(LaserScan()), {}, update());
  EXPECT_TRUE(grid.tiles().bounds().empty());
}

// Cells are numbered by an int: with 5 cm, the last one ends at 107,374 km.
TEST(OccupancyGrid, AScanAtTheEndOfTheNumbersIsAnError) {
  for (const double x : {0x1p31 * 0.05 - 45, -0x1p31 * 0.05 + 45, 1e300, std::nan("")}) {
    OccupancyGrid grid(0.05);
    EXPECT_THROW(grid.insert(beams({{0, 50}, {1, 50}}), {x, 0, 0}, update()), InputError) << x;
    EXPECT_TRUE(grid.tiles().bounds().empty());
  }
  OccupancyGrid grid(0.01);
  grid.insert(beams({{0, 50}}), {9.9e6, -9.9e6, 0}, update());
  EXPECT_FALSE(grid.tiles().bounds().empty()) << "in reach with the smallest cells";
}

/// The cells that a beam crosses, found by clipping it to each cell.
std::set<std::pair<int, int>> crossed(double x, double y, double heading, double length) {
  const double dir[] = {std::cos(heading), std::sin(heading)}, from[] = {x, y};
  const int reach = static_cast<int>(length) + 1;
  std::set<std::pair<int, int>> cells;
  for (int cx = static_cast<int>(std::floor(x)) - reach; cx <= x + reach; ++cx)
    for (int cy = static_cast<int>(std::floor(y)) - reach; cy <= y + reach; ++cy) {
      double entry = 0, exit = length;
      for (const auto& [axis, low] : {std::pair(0, cx), std::pair(1, cy)}) {
        const double a = (low - from[axis]) / dir[axis], b = (low + 1 - from[axis]) / dir[axis];
        entry = std::max(entry, std::min(a, b)), exit = std::min(exit, std::max(a, b));
      }
      if (entry < exit) cells.insert({cx, cy});
    }
  return cells;
}

/// Compares random scans with the rules applied cell by cell to a plain map.
TEST(OccupancyGrid, RandomScansAgreeWithAPlainMap) {
  RandomStream random(1, 0, 0);
  const auto uniform = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const double size = 0.1;
  OccupancyGrid grid(size);
  std::map<std::pair<int, int>, int> reference;
  for (int scan = 0; scan < 30; ++scan) {
    const TPose2D robot(uniform(-5, 5), uniform(-5, 5), uniform(-M_PI, M_PI));
    const TPose2D sensor(uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-M_PI, M_PI));
    std::vector<Reading> readings;
    for (int i = 0; i < 60; ++i) readings.push_back({uniform(-2, 2), uniform(0.1, 8)});
    grid.insert(beams(readings, sensor), robot, update());

    const TPose2D laser = robot + sensor;
    std::set<std::pair<int, int>> hits;
    for (const Reading& r : readings) {
      const CellIndex end = grid.cellOf(laser.x + r.range * std::cos(laser.phi + r.angle),
                                        laser.y + r.range * std::sin(laser.phi + r.angle));
      hits.insert({end.x, end.y});
    }
    for (const auto& cell : hits) reference[cell] = std::min(reference[cell] + kHit, kHighest);
    for (const Reading& r : readings)
      for (const auto& cell : crossed(laser.x / size, laser.y / size, laser.phi + r.angle, r.range / size))
        if (!hits.count(cell)) reference[cell] = std::max(reference[cell] + kMiss, kLowest);
  }
  for (const auto& [cell, value] : reference)
    ASSERT_EQ(grid.tiles().at({cell.first, cell.second}), value) << cell.first << " " << cell.second;
  size_t known = 0;
  grid.tiles().forEachTile([&](int tx, int ty, const Tile&) {
    for (int y = ty * Tile::kSize; y < (ty + 1) * Tile::kSize; ++y)
      for (int x = tx * Tile::kSize; x < (tx + 1) * Tile::kSize; ++x) known += grid.tiles().at({x, y}) != 0;
  });
  EXPECT_EQ(known,
            std::count_if(reference.begin(), reference.end(), [](const auto& cell) { return cell.second; }));
}

TEST(OccupancyGrid, ACopyKeepsItsMap) {
  OccupancyGrid first(1);
  first.insert(beams({{0, 3}}), {0.5, 0.5, 0}, update());
  OccupancyGrid second = first;
  second.insert(beams({{0, 3}}), {0.5, 0.5, 0}, update());
  EXPECT_EQ(first.tiles().at({3, 0}), kHit);
  EXPECT_EQ(second.tiles().at({3, 0}), 2 * kHit);
}

TEST(OccupancyGrid, CellsAtTheirBoundsStayShared) {
  const ScanBeams scan = beams({{-0.5, 3}, {0, 4}, {0.5, 3.5}});
  OccupancyGrid first(0.05);
  for (int i = 0; i < 120; ++i) first.insert(scan, {}, update());
  OccupancyGrid second = first;
  second.insert(scan, {}, update());
  size_t tiles = 0;
  first.tiles().forEachTile([&](int tx, int ty, const Tile& tile) {
    EXPECT_EQ(second.tiles().tileAt(tx, ty), &tile);
    ++tiles;
  });
  EXPECT_GE(tiles, 4u);
}

/// More beams pass through the cell than its counter can hold.
TEST(OccupancyGrid, AThousandBeamsThroughOneCell) {
  std::vector<Reading> readings;
  for (int i = 0; i < 1000; ++i) readings.push_back({0.001 * i - 0.5, 3});
  OccupancyGrid grid(0.05);
  GridOptions options = update();
  options.pMin = 0.001;
  grid.insert(beams(readings), {0.025, 0.025, 0}, options);
  EXPECT_EQ(grid.tiles().at({0, 0}), -111);  // 16 ln(0.001 / 0.999) = -110.5
}

}  // namespace
}  // namespace hybrid_slam
