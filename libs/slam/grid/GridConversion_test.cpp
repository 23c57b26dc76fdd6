#include "slam/grid/GridConversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/Errors.h"
#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using mrpt::maps::COccupancyGridMap2D;

/// `n` cells with random values, somewhere within `reach` cells of the origin.
OccupancyGrid randomGrid(RandomStream& random, double resolution, int n, int reach) {
  OccupancyGrid grid(resolution);
  const auto coordinate = [&] {
    return static_cast<int>(random.bits() % static_cast<uint64_t>(2 * reach)) - reach;
  };
  for (int i = 0; i < n; ++i)
    grid.tiles().set({coordinate(), coordinate()},
                     static_cast<int8_t>(static_cast<int>(random.bits() % 255) - 127));
  return grid;
}

void expectSameCells(const OccupancyGrid& a, const OccupancyGrid& b) {
  EXPECT_EQ(a.resolution(), b.resolution());
  for (const auto& [grid, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    grid->tiles().forEachTile([&other = other](int tx, int ty, const Tile& tile) {
      for (int i = 0; i < Tile::kSize * Tile::kSize; ++i) {
        const CellIndex cell{tx * Tile::kSize + i % Tile::kSize, ty * Tile::kSize + i / Tile::kSize};
        ASSERT_EQ(other->tiles().at(cell), tile.cells()[static_cast<size_t>(i)]) << cell.x << " " << cell.y;
      }
    });
}

TEST(GridConversion, RoundTripKeepsEveryCell) {
  RandomStream random(1, 0, 0);
  for (const double resolution : {0.01, 0.05, 0.1, 0.2, 0.37, 1.0})
    for (const int reach : {1, 40, 700}) {
      const OccupancyGrid grid = randomGrid(random, resolution, 500, reach);
      expectSameCells(fromMrpt(toMrpt(grid)), grid);
    }
}

TEST(GridConversion, FarFromTheOriginToo) {
  OccupancyGrid grid(0.05);
  for (const int x : {-40000, 40000})  // 2 km
    grid.tiles().set({x, x / 2}, 77);
  for (const int x : {-40000, 40000}) {
    const CellBox box{{x - 10, x / 2 - 10}, {x + 10, x / 2 + 10}};
    const OccupancyGrid part = fromMrpt(toMrpt(grid, box));
    EXPECT_EQ(part.tiles().at({x, x / 2}), 77);
    EXPECT_EQ(part.tiles().at({x + 1, x / 2}), 0);
  }
}

TEST(GridConversion, ACellIsWhereMrptExpectsIt) {
  RandomStream random(2, 0, 0);
  const OccupancyGrid grid = randomGrid(random, 0.05, 2000, 300);
  const COccupancyGridMap2D mrptGrid = toMrpt(grid);
  for (int i = 0; i < 5000; ++i) {
    const double x = 30 * random.uniform() - 15, y = 30 * random.uniform() - 15;
    const double rest = std::abs(std::remainder(x, 0.05)), restY = std::abs(std::remainder(y, 0.05));
    if (rest < 1e-4 || restY < 1e-4) continue;  // MRPT's origin is a float: borders are not exact
    const int cx = mrptGrid.x2idx(x), cy = mrptGrid.y2idx(y);
    ASSERT_EQ(mrptGrid.getCell(cx, cy),
              mrptGrid.l2p(static_cast<int8_t>(-grid.tiles().at(grid.cellOf(x, y)))))
        << x << " " << y;
    const double half = 0.025 + 1e-4;
    EXPECT_NEAR(mrptGrid.idx2x(cx), x, half);
    EXPECT_NEAR(mrptGrid.idx2y(cy), y, half);
  }
}

TEST(GridConversion, TheProbabilitiesAgreeAndPositiveIsOccupiedHere) {
  OccupancyGrid grid(0.1);
  grid.tiles().set({3, 4}, 30), grid.tiles().set({-3, -4}, -30);
  const COccupancyGridMap2D mrptGrid = toMrpt(grid);
  // MRPT gives the probability of being free, from a table of 8-bit steps.
  EXPECT_NEAR(1 - mrptGrid.getPos(0.35f, 0.45f), grid.occupancy({3, 4}), 1e-6);
  EXPECT_NEAR(1 - mrptGrid.getPos(-0.25f, -0.35f), grid.occupancy({-3, -4}), 1e-6);
  EXPECT_GT(grid.occupancy({3, 4}), 0.8);
}

TEST(GridConversion, ABoxIsCutOut) {
  RandomStream random(3, 0, 0);
  const OccupancyGrid grid = randomGrid(random, 0.05, 20000, 100);
  for (const CellBox& box : {CellBox{{-20, -30}, {15, 7}}, CellBox{{50, 60}, {50, 60}},
                             CellBox{{-300, -300}, {-200, -250}}, CellBox{{90, 90}, {120, 130}}}) {
    const COccupancyGridMap2D part = toMrpt(grid, box);
    ASSERT_EQ(static_cast<int>(part.getSizeX()), box.max.x - box.min.x + 1);
    ASSERT_EQ(static_cast<int>(part.getSizeY()), box.max.y - box.min.y + 1);
    for (int y = box.min.y; y <= box.max.y; ++y)
      for (int x = box.min.x; x <= box.max.x; ++x)
        ASSERT_EQ(part.getRow(y - box.min.y)[x - box.min.x], -grid.tiles().at({x, y}));
  }
}

TEST(GridConversion, ALargerMapGetsTheFinestCellsThatFit) {
  RandomStream random(4, 0, 0);
  const OccupancyGrid grid = randomGrid(random, 0.05, 20000, 300);
  const CellBox box = grid.tiles().bounds();
  for (const int merge : {2, 3, 7}) {
    const auto side = static_cast<size_t>((box.max.x - box.min.x + 1) / merge + 5);
    const COccupancyGridMap2D merged = toMrpt(grid, side * side);
    ASSERT_NEAR(merged.getResolution(), 0.05 * merge, 1e-6);
    EXPECT_LE(merged.getSizeX() * merged.getSizeY(), side * side);
    const OccupancyGrid coarse = fromMrpt(merged);
    for (int y = -300 / merge * merge; y < 300; y += merge)
      for (int x = -300 / merge * merge; x < 300; x += merge) {
        std::vector<int> known;
        for (int j = 0; j < merge; ++j)
          for (int i = 0; i < merge; ++i)
            if (const int value = grid.tiles().at({x + i, y + j}); value != 0) known.push_back(value);
        const int expected = known.empty() ? 0 : *std::max_element(known.begin(), known.end());
        ASSERT_EQ(coarse.tiles().at(coarse.cellOf((x + 0.5) * 0.05, (y + 0.5) * 0.05)), expected)
            << merge << ": " << x << ' ' << y;
      }
  }
}

TEST(GridConversion, AMapOfMoreThan32BitsOfCells) {
  for (const int far : {70000, 200000, 2000000}) {  // cells: 3.5, 10 and 100 km
    OccupancyGrid grid(0.05);
    grid.tiles().set({0, 0}, 77), grid.tiles().set({far, far}, 77), grid.tiles().set({far - 1, far}, -40);
    const COccupancyGridMap2D merged = toMrpt(grid);
    EXPECT_LE(merged.getSizeX() * merged.getSizeY(), kMostCells);
    EXPECT_EQ(merged.getRawMap().size(), size_t{merged.getSizeX()} * merged.getSizeY());
    EXPECT_LT(merged.getPos(0.02f, 0.02f), 0.1) << "the wall is kept";
    EXPECT_LT(merged.getPos(static_cast<float>(0.05 * far), static_cast<float>(0.05 * far)), 0.1);
  }
}

TEST(GridConversion, ABoxIsNeverMerged) {
  EXPECT_THROW(toMrpt(OccupancyGrid(0.05), CellBox{{-70000, -70000}, {70000, 70000}}), InputError);
}

TEST(GridConversion, AnEmptyGridIsAFewUnknownCells) {
  const COccupancyGridMap2D mrptGrid = toMrpt(OccupancyGrid(0.05));
  ASSERT_GT(mrptGrid.getSizeX(), 0u);
  for (unsigned int x = 0; x < mrptGrid.getSizeX(); ++x) EXPECT_EQ(mrptGrid.getRow(0)[x], 0);
  EXPECT_TRUE(fromMrpt(mrptGrid).tiles().bounds().empty());
}

TEST(GridConversion, MrptsLowestValueBecomesOurs) {
  COccupancyGridMap2D mrptGrid(-1, 1, -1, 1, 0.1f);
  mrptGrid.getRow(10)[10] = -128;  // has no negative in eight bits
  EXPECT_EQ(fromMrpt(mrptGrid).tiles().at({0, 0}), 127);
}

TEST(GridConversion, AnOriginOffTheCellsIsAnError) {
  // MRPT aligns a new grid with whole cells, but accepts an offset of a twentieth of a cell when it grows.
  COccupancyGridMap2D mrptGrid(-1, 1, -1, 1, 0.1f);
  EXPECT_NO_THROW(fromMrpt(mrptGrid));
  mrptGrid.resizeGrid(-1.996f, 1, -1, 1, 0.5f, false);
  ASSERT_NEAR(mrptGrid.getXMin(), -1.996, 1e-6);
  EXPECT_THROW(fromMrpt(mrptGrid), InputError);
}

}  // namespace
}  // namespace hybrid_slam
