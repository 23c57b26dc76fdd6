#include "slam/grid/GridConversion.h"

#include <gtest/gtest.h>

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
