#include "run/MapRaster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/grid/GridConversion.h"
#include "testing/TestScans.h"

namespace hybrid_slam::run {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPose2D;

/// A corridor of 12 m x 2 m, along which a robot drives 10 m from the origin. Its laser sees 180 deg, from
/// 0.4 m ahead: at the start, no beam crosses the robot's position.
class Corridor : public testing::Test {
 protected:
  Corridor() {
    RandomStream random(1, 0, 0);
    const test::Walls walls = test::polygon({{-1, -1}, {11, -1}, {11, 1}, {-1, 1}});
    OccupancyGrid grid;
    GridOptions options;
    options.maxRange = 4;
    for (double x = 0; x <= 10; x += 0.5) {
      const TPose2D robot(x, 0.05 * std::sin(x), 0);
      const LaserScan scan = test::scanOf(walls, robot, {0.4, 0, 0}, 181, M_PI, 0, random);
      LaserScan within = scan;
      for (auto& beam : within.beams) beam.range = std::min(beam.range, 8.0);
      grid.insert(ScanBeams(within), robot, options);
      trajectory.push_back({x, robot});
    }
    cells = toMrpt(grid);
  }
  static uint8_t at(const MapRaster& map, double x, double y) {
    return map.at(static_cast<int>(std::floor((x - map.left()) / map.cell())),
                  map.height() - 1 - static_cast<int>(std::floor((y - map.bottom()) / map.cell())));
  }
  files::Trajectory trajectory;
  COccupancyGridMap2D cells;
};

TEST_F(Corridor, NoCellWithinTheRobotsRadiusOfItsPathIsUnknown) {
  const MapRaster map(cells, trajectory);
  for (double x = -0.15; x <= 10.15; x += map.cell())
    for (double y = -0.15; y <= 0.15; y += map.cell())
      ASSERT_EQ(at(map, x, y), MapRaster::kFree) << x << ' ' << y;
}

TEST_F(Corridor, ACellIsFreeIfABeamCrossedItAndUnknownIfNoneDid) {
  const MapRaster map(cells, {});
  size_t free = 0, unknown = 0;
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      const float x = static_cast<float>(map.left() + (column + 0.5) * map.cell());
      const float y = static_cast<float>(map.bottom() + (map.height() - row - 0.5) * map.cell());
      const auto value = cells.getRow(cells.y2idx(y))[cells.x2idx(x)];
      if (value >= 0) {
        ASSERT_EQ(map.at(column, row), value > 0 ? MapRaster::kFree : MapRaster::kUnknown) << x << ' ' << y;
      }
      free += value > 0, unknown += value == 0;
    }
  EXPECT_GT(free, 0.9 * 11 * 2 / 0.05 / 0.05);
  EXPECT_GT(unknown, 1000u);
  EXPECT_EQ(at(map, 0, 0), MapRaster::kUnknown) << "behind the laser";
}

TEST(MapRaster, WallsStayWhereTheRobotDrove) {
  COccupancyGridMap2D cells;
  cells.setSize(-1, 1, -1, 1, 0.05f, 0.5f);
  cells.setCell(20, 20, 0.1f);  // from (0, 0)
  cells.setCell(22, 20, 0.45f);
  const MapRaster map(cells, {{0, {0, 0, 0}}});
  const int column = static_cast<int>(std::lround(-map.left() / map.cell()));
  const int row = map.height() - 1 - static_cast<int>(std::lround(-map.bottom() / map.cell()));
  EXPECT_EQ(map.at(column, row), MapRaster::kOccupied);
  EXPECT_EQ(map.at(column + 2, row), MapRaster::kFree) << "one hit";
  EXPECT_EQ(map.at(column + 4, row), MapRaster::kFree) << "within 0.25 m";
  EXPECT_EQ(map.at(column + 6, row), MapRaster::kUnknown);
}

TEST(MapRaster, AGapInTheLogIsNotDriven) {
  COccupancyGridMap2D cells;
  cells.setSize(-1, 9, -1, 1, 0.05f, 0.5f);
  cells.setCell(0, 0, 0.9f), cells.setCell(199, 39, 0.9f);
  const auto valueAt = [&cells](double x, const files::Trajectory& trajectory) {
    const MapRaster map(cells, trajectory);
    return map.at(static_cast<int>((x + 1) / 0.05), 20);
  };
  EXPECT_EQ(valueAt(0.5, {{0, {0, 0, 0}}, {1, {0.9, 0, 0}}}), MapRaster::kFree);
  EXPECT_EQ(valueAt(4, {{0, {0, 0, 0}}, {1, {8, 0, 0}}}), MapRaster::kUnknown);
  EXPECT_EQ(valueAt(8, {{0, {0, 0, 0}}, {1, {8, 0, 0}}}), MapRaster::kFree);
  EXPECT_EQ(valueAt(4, {{0, {1e9, NAN, 0}}}), MapRaster::kUnknown);
}

/// A log may have a scan per metre (MIT Killian Court: up to 1.3 m).
TEST(MapRaster, BetweenScansThatAreFarApartThePathIsFreeUnlessSomethingStandsThere) {
  COccupancyGridMap2D cells;
  cells.setSize(-1, 9, -1, 1, 0.05f, 0.5f);
  cells.setCell(0, 0, 0.9f), cells.setCell(199, 39, 0.9f);
  const auto valueAt = [&cells](double x, double to) {
    const MapRaster map(cells, {{0, {0, 0, 0}}, {1, {to, 0, 0}}});
    return map.at(static_cast<int>((x + 1) / 0.05), 20);
  };
  EXPECT_EQ(valueAt(0.67, 1.3), MapRaster::kFree);
  EXPECT_EQ(valueAt(0.97, 1.9), MapRaster::kFree);
  EXPECT_EQ(valueAt(1.07, 2.1), MapRaster::kUnknown) << "a gap in the log";
  cells.setCell(cells.x2idx(0.67f), cells.y2idx(0.01f), 0.1f);
  EXPECT_EQ(valueAt(0.47, 1.3), MapRaster::kUnknown) << "a wall: it drove around";
  EXPECT_EQ(valueAt(0.47, 0.9), MapRaster::kFree) << "too close for a way around";
}

TEST(MapRaster, AReducedMapKeepsThinWalls) {
  COccupancyGridMap2D cells;
  cells.setSize(0, 1, 0, 1, 0.05f, 0.5f);
  cells.setCell(1, 18, 0.9f), cells.setCell(2, 18, 0.1f), cells.setCell(5, 18, 0.9f);
  const MapRaster map(cells, {});
  EXPECT_EQ(map.at(0, 0, 4), MapRaster::kOccupied);
  EXPECT_EQ(map.at(4, 0, 4), MapRaster::kFree);
  EXPECT_EQ(map.at(12, 0, 4), MapRaster::kUnknown);
  EXPECT_EQ(map.at(map.width() - 1, map.height() - 1, 4), MapRaster::kUnknown) << "beyond the edge";
}

}  // namespace
}  // namespace hybrid_slam::run
