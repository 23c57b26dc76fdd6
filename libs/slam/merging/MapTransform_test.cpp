#include "slam/merging/MapTransform.h"

#include <gtest/gtest.h>

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

DatabaseLine lineOf(const TPoint2D& start, const TPoint2D& end, int count) {
  DatabaseLine line;
  static_cast<LineSegment&>(line) = makeSegment(start, end);
  line.count = count;
  return line;
}

TEST(Resampled, AQuarterTurnKeepsEveryCell) {
  OccupancyGrid grid(0.1);
  grid.tiles().set({3, 1}, 40);
  grid.tiles().set({4, 1}, -20);
  grid.tiles().set({-70, 50}, 7);
  const OccupancyGrid turned = resampled(grid, {1, 2, M_PI / 2}, 0.1);
  EXPECT_EQ(turned.tiles().at({8, 23}), 40);
  EXPECT_EQ(turned.tiles().at({8, 24}), -20);
  EXPECT_EQ(turned.tiles().at({-41, -50}), 7);
  EXPECT_EQ(turned.tiles().at({3, 1}), 0);
}

TEST(Resampled, ACoarseCellTakesTheHighestKnownOccupancy) {
  OccupancyGrid grid(0.05);
  grid.tiles().set({0, 0}, -30);
  grid.tiles().set({1, 1}, -10);
  grid.tiles().set({2, 0}, -30);
  grid.tiles().set({3, 1}, 20);
  const OccupancyGrid coarse = resampled(grid, {}, 0.1);
  EXPECT_EQ(coarse.resolution(), 0.1);
  EXPECT_EQ(coarse.tiles().at({0, 0}), -10);
  EXPECT_EQ(coarse.tiles().at({1, 0}), 20);
  EXPECT_EQ(coarse.tiles().at({2, 0}), 0);
}

TEST(Resampled, ACoarseCellFillsItsFineOnes) {
  OccupancyGrid grid(0.1);
  grid.tiles().set({-1, 0}, 9);
  const OccupancyGrid fine = resampled(grid, {}, 0.05);
  for (const CellIndex cell : {CellIndex{-2, 0}, {-1, 0}, {-2, 1}, {-1, 1}})
    EXPECT_EQ(fine.tiles().at(cell), 9);
  EXPECT_EQ(fine.tiles().at({0, 0}), 0);
}

TEST(AddMap, LinesWeighByTheirObservations) {
  ScanMap map{OccupancyGrid(0.1), LineDatabase({lineOf({0, 10}, {8, 10}, 3)})},
      other{OccupancyGrid(0.1), LineDatabase({lineOf({0, 10.1}, {8, 10.1}, 997)})};
  addMap(map, other, {}, GridOptions(), AssociationOptions(), LineDatabaseOptions());
  ASSERT_EQ(map.lines.lines().size(), 1u);
  EXPECT_EQ(map.lines.lines()[0].count, 1000);
  EXPECT_NEAR(map.lines.lines()[0].rho, 10.0997, 1e-9);
}

/// A line that a long run saw once, at its end.
TEST(AddMap, LinesOfTheOtherMapArePruned) {
  DatabaseLine late = lineOf({0, 10}, {8, 10}, 1);
  late.inserted = 1006;
  ScanMap map{OccupancyGrid(0.1), LineDatabase()}, other{OccupancyGrid(0.1), LineDatabase({late})};
  addMap(map, other, {}, GridOptions(), AssociationOptions(), LineDatabaseOptions());
  for (int i = 0; i < 20; ++i) map.lines.update({}, LineDatabaseOptions(), AssociationOptions());
  EXPECT_TRUE(map.lines.lines().empty());
}

TEST(AddMap, EvidenceAddsUpWithinTheLimits) {
  ScanMap map{OccupancyGrid(0.1), LineDatabase()}, other = map;
  map.grid.tiles().set({0, 0}, 10);
  map.grid.tiles().set({1, 0}, 50);
  other.grid.tiles().set({0, 0}, 12);
  other.grid.tiles().set({1, 0}, 50);
  other.grid.tiles().set({2, 0}, -5);
  addMap(map, other, {}, GridOptions(), AssociationOptions(), LineDatabaseOptions());
  EXPECT_EQ(map.grid.tiles().at({0, 0}), 22);
  EXPECT_EQ(map.grid.tiles().at({1, 0}), 56);  // 0.97
  EXPECT_EQ(map.grid.tiles().at({2, 0}), -5);
}

TEST(AddMap, TheSameWallIsOneLine) {
  const LineDatabase lines({lineOf({0, 0}, {6, 0}, 4), lineOf({0, 0}, {0, 8}, 5)});
  ScanMap map{OccupancyGrid(0.1), lines};
  const TPose2D frame(3, 4, 0.3);
  const ScanMap other{OccupancyGrid(0.1),
                      LineDatabase(transformed(std::vector<DatabaseLine>{lineOf({2, 0.02}, {9, 0.02}, 3),
                                                                         lineOf({5, 5}, {12, 5}, 3)},
                                               TPose2D() - frame))};
  addMap(map, other, frame, GridOptions(), AssociationOptions(), LineDatabaseOptions());
  ASSERT_EQ(map.lines.lines().size(), 3u);
  const DatabaseLine& wall = map.lines.lines()[0];
  EXPECT_NEAR(wall.length, 9, 0.01);
  EXPECT_EQ(wall.count, 7);
  EXPECT_NEAR(map.lines.lines()[2].length, 7, 1e-9);
  EXPECT_NEAR(map.lines.lines()[2].rho, 5, 1e-9);
}

}  // namespace
}  // namespace hybrid_slam
