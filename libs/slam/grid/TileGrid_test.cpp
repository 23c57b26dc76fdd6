#include "slam/grid/TileGrid.h"

#include <gtest/gtest.h>

#include <map>
#include <new>
#include <thread>
#include <vector>

#include "base/Errors.h"
#include "base/Memory.h"
#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using Cells = std::map<std::pair<int, int>, int8_t>;

/// A whole number in [low, high].
int between(RandomStream& random, int low, int high) {
  return low + static_cast<int>(random.bits() % static_cast<uint64_t>(high - low + 1));
}

/// The cells of the grid that are not 0.
Cells knownCells(const TileGrid& grid) {
  Cells cells;
  grid.forEachTile([&](int tx, int ty, const Tile&) {
    for (int y = ty * Tile::kSize; y < (ty + 1) * Tile::kSize; ++y)
      for (int x = tx * Tile::kSize; x < (tx + 1) * Tile::kSize; ++x)
        if (const int8_t value = grid.at({x, y})) cells[{x, y}] = value;
  });
  return cells;
}

TEST(TileGrid, GrowsWithinALimitOfTheMemory) {
  const auto grow = [] {
    TileGrid grid;
    for (int i = 0; i < 1 << 14; ++i) grid.writableTile(i, 0);
  };
  {
    const ResidentLimit limit(residentBytes() / 2);
    EXPECT_THROW(grow(), std::bad_alloc);
  }
  {
    const ResidentLimit limit(residentBytes() + 1e9);
    EXPECT_NO_THROW(grow());
  }
  EXPECT_NO_THROW(grow()) << "without a limit";
}

// One step may take a robot far away, and a window of blocks has 16 bytes for each block in between.
TEST(TileGrid, AWindowOverTheLimitOfTheMemoryIsNotMade) {
  constexpr int kBlock = 16;  // tiles
  const auto grow = [] {
    TileGrid grid;
    grid.writableTile(0, 0);
    grid.writableTile(3000 * kBlock, 3000 * kBlock);  // 144 MB
  };
  {
    const ResidentLimit limit(residentBytes() + 4e7);
    EXPECT_THROW(grow(), std::bad_alloc);
  }
  const ResidentLimit limit(residentBytes() + 2e8);
  EXPECT_NO_THROW(grow());
}

TEST(TileGrid, IsUnknownWhereNothingWasWritten) {
  const TileGrid grid;
  EXPECT_EQ(grid.at({0, 0}), 0);
  EXPECT_EQ(grid.at({-1000000, 1000000}), 0);
  EXPECT_EQ(grid.tileAt(0, 0), nullptr);
  EXPECT_TRUE(grid.bounds().empty());
}

TEST(TileGrid, AMapThatIsTooLargeIsAnError) {
  TileGrid grid;
  grid.set({0, 0}, 1);
  EXPECT_THROW(grid.set({1 << 28, 1 << 28}, 1), InputError);
  EXPECT_EQ(grid.at({0, 0}), 1);
  grid.set({1 << 28, 0}, 1);  // long, but thin
  EXPECT_EQ(grid.at({1 << 28, 0}), 1);
}

TEST(TileGrid, GrowsInEveryDirectionAndKeepsItsContent) {
  TileGrid grid;
  Cells cells;
  int8_t value = 0;
  for (const int reach : {0, 1, 31, 32, 511, 512, 513, 5000, 40000})
    for (const int sx : {-1, 0, 1})
      for (const int sy : {-1, 0, 1}) {
        grid.set({sx * reach, sy * reach}, ++value);
        cells[{sx * reach, sy * reach}] = value;
      }
  EXPECT_EQ(knownCells(grid), cells);
}

TEST(TileGrid, NegativeCellsLieInTilesOfTheirOwn) {
  TileGrid grid;
  grid.set({-1, -1}, 7);
  EXPECT_EQ(grid.tileAt(0, 0), nullptr);
  ASSERT_NE(grid.tileAt(-1, -1), nullptr);
  EXPECT_EQ(grid.tileAt(-1, -1)->cells().back(), 7);
  EXPECT_EQ(grid.at({31, 31}), 0);
}

TEST(TileGrid, BoundsAreThoseOfTheTilesWritten) {
  TileGrid grid;
  grid.set({-1, 70}, 1);
  CellBox box = grid.bounds();
  EXPECT_EQ(box.min, (CellIndex{-32, 64}));
  EXPECT_EQ(box.max, (CellIndex{-1, 95}));
  grid.set({600, -600}, 1);
  box = grid.bounds();
  EXPECT_EQ(box.min, (CellIndex{-32, -608}));
  EXPECT_EQ(box.max, (CellIndex{607, 95}));
}

TEST(TileGrid, AReaderFollowsAnyPath) {
  RandomStream random(1, 0, 0);
  TileGrid grid;
  Cells cells;
  for (int i = 0; i < 5000; ++i) {
    const int x = between(random, -700, 700), y = between(random, -700, 700);
    const auto value = static_cast<int8_t>(between(random, 1, 127));
    grid.set({x, y}, value);
    cells[{x, y}] = value;
  }
  TileReader reader(grid);
  for (const auto& [cell, value] : cells) ASSERT_EQ(reader.at(cell.first, cell.second), value);
  for (int i = 0; i < 5000; ++i) {
    const int x = between(random, -2000, 2000), y = between(random, -2000, 2000);
    const auto known = cells.find({x, y});
    ASSERT_EQ(reader.at(x, y), known == cells.end() ? 0 : known->second);
  }
}

TEST(Tile, ASquareIsFreeIfAllItsCellsAre) {
  RandomStream random(4, 0, 0);
  Tile tile;
  const auto expectFlagsOf = [](const Tile& t) {
    for (int sy = 0; sy < 4; ++sy)
      for (int sx = 0; sx < 4; ++sx) {
        bool isFree = true;
        for (int i = 0; i < 64; ++i) isFree &= t.cells()[Tile::index(8 * sx + i % 8, 8 * sy + i / 8)] < 0;
        ASSERT_EQ(t.isFree(sx, sy), isFree) << sx << " " << sy;
        ASSERT_EQ(t.isFree(sx - 8, sy + 12), isFree);  // for coordinates in any tile of a grid
      }
  };
  expectFlagsOf(tile);
  Tile::Cells cells;
  for (int round = 0; round < 50; ++round) {
    for (int8_t& cell : cells) cell = static_cast<int8_t>(between(random, -127, -1));
    for (int i = 0; i < round; ++i)
      cells[random.bits() % cells.size()] = static_cast<int8_t>(between(random, 0, 127));
    tile.assign(cells);
    expectFlagsOf(tile);
    for (int i = 0; i < 300; ++i)
      tile.set(between(random, 0, 31), between(random, 0, 31), static_cast<int8_t>(between(random, -90, 1)));
    expectFlagsOf(tile);
  }
}

TEST(TileGrid, ACopySharesAllTilesAndAWriteUnsharesOne) {
  TileGrid first;
  for (int i = -10; i < 10; ++i) first.set({i * 100, -i * 100}, 1);
  TileGrid second = first;
  second.set({300, -300}, 9);
  size_t shared = 0, own = 0;
  first.forEachTile(
      [&](int tx, int ty, const Tile& tile) { (second.tileAt(tx, ty) == &tile ? shared : own) += 1; });
  EXPECT_EQ(own, 1u);
  EXPECT_EQ(shared, 19u);
  EXPECT_EQ(first.at({300, -300}), 1);
  EXPECT_EQ(second.at({300, -300}), 9);
}

/// A grid and its expected content, with a number per tile that two grids share only until one of them writes
/// to the tile.
struct Modelled {
  TileGrid grid;
  Cells cells;
  std::map<std::pair<int, int>, int> tiles;
};

/// Particles that copy each other and write, as resampling and map updates make them.
TEST(TileGrid, RandomCopiesAndWritesAgreeWithPlainMaps) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    RandomStream random(2, seed, 0);
    std::vector<Modelled> particles(6);
    int tileNumber = 0;
    for (int step = 0; step < 300; ++step) {
      auto& particle = particles[random.bits() % particles.size()];
      if (random.uniform() < 0.3) {
        particle = particles[random.bits() % particles.size()];
        continue;
      }
      const int cx = between(random, -1200, 1200), cy = between(random, -1200, 1200);
      for (int i = 0; i < 20; ++i) {
        const int x = cx + between(random, -40, 40), y = cy + between(random, -40, 40);
        const auto value = static_cast<int8_t>(between(random, 1, 127));
        particle.grid.set({x, y}, value);
        particle.cells[{x, y}] = value;
        particle.tiles[{x >> Tile::kBits, y >> Tile::kBits}] = ++tileNumber;
      }
    }
    for (const auto& a : particles) {
      ASSERT_EQ(knownCells(a.grid), a.cells);
      for (const auto& b : particles)
        for (const auto& [tile, number] : a.tiles) {
          const auto other = b.tiles.find(tile);
          ASSERT_EQ(a.grid.tileAt(tile.first, tile.second) == b.grid.tileAt(tile.first, tile.second),
                    other != b.tiles.end() && other->second == number);
        }
    }
  }
}

void writeAtRandom(TileGrid& grid, uint64_t seed) {
  RandomStream random(3, seed, 0);
  for (int i = 0; i < 3000; ++i)
    grid.set({between(random, -600, 600), between(random, -600, 600)},
             static_cast<int8_t>(between(random, -127, 127)));
}

TEST(TileGrid, ThreadsThatWriteCopiesOfOneGridGiveTheResultOfOneThread) {
  TileGrid origin;
  writeAtRandom(origin, 99);
  const Cells untouched = knownCells(origin);
  std::vector<TileGrid> serial(8, origin), parallel(8, origin);
  for (size_t i = 0; i < serial.size(); ++i) writeAtRandom(serial[i], i);
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (size_t i = t; i < parallel.size(); i += 4) writeAtRandom(parallel[i], i);
    });
  for (auto& thread : threads) thread.join();
  for (size_t i = 0; i < serial.size(); ++i) EXPECT_EQ(knownCells(parallel[i]), knownCells(serial[i])) << i;
  EXPECT_EQ(knownCells(origin), untouched);
}

}  // namespace
}  // namespace hybrid_slam
