#include "run/MapReader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/Errors.h"
#include "files/RawlogWriter.h"
#include "files/TemporaryFolder.h"
#include "run/MapFiles.h"
#include "slam/grid/GridConversion.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int8_t kOccupied = 56, kFree = -56;  // log-odds of 0.97 and 0.03, in 16ths

/// A wall, free cells before it and one cell far off, around (0, 0).
OccupancyGrid smallMap(double resolution = 0.05) {
  OccupancyGrid grid(resolution);
  for (int x = -40; x < 50; ++x) {
    grid.tiles().set({x, 10}, static_cast<int8_t>(30 + x));
    for (int y = -33; y < 10; ++y) grid.tiles().set({x, y}, static_cast<int8_t>(-20 - (x + y) % 30));
  }
  grid.tiles().set({-300, 70}, 127);
  return grid;
}

void expectSameCells(const OccupancyGrid& a, const OccupancyGrid& b) {
  EXPECT_EQ(a.resolution(), b.resolution());
  const auto isIn = [](const OccupancyGrid& inner, const OccupancyGrid& outer) {
    bool isEqual = true;
    inner.tiles().forEachTile([&](int tx, int ty, const Tile& tile) {
      for (int y = 0; y < Tile::kSize; ++y)
        for (int x = 0; x < Tile::kSize; ++x)
          isEqual &= tile.cells()[Tile::index(x, y)] ==
                     outer.tiles().at({tx * Tile::kSize + x, ty * Tile::kSize + y});
    });
    return isEqual;
  };
  EXPECT_TRUE(isIn(a, b));
  EXPECT_TRUE(isIn(b, a));
}

class MapReader : public testing::Test {
 protected:
  std::string errorOf(const std::string& file) {
    try {
      readMap(file);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::Not(HasSubstr("\n")));
      return e.what();
    }
    return "";
  }
  files::TemporaryFolder root;
  files::OutputFolder folder{root.path("out")};
};

TEST_F(MapReader, AGridMapKeepsEveryCell) {
  for (const double resolution : {0.05, 0.1, 0.025, 0.033333335, 0.15}) {
    SCOPED_TRACE(resolution);
    const OccupancyGrid grid = smallMap(resolution);
    saveGridMap(folder, toMrpt(grid));
    expectSameCells(readMap(folder.path("map.gridmap.gz")), grid);
  }
}

TEST_F(MapReader, AGridMapWithoutCompression) {
  const OccupancyGrid grid = smallMap();
  test::writePlain(root.path("map.gridmap"),
                   {std::make_shared<mrpt::maps::COccupancyGridMap2D>(toMrpt(grid))});
  expectSameCells(readMap(root.path("map.gridmap")), grid);
}

TEST_F(MapReader, ARosMapKeepsWhatIsOccupiedFreeAndUnknown) {
  for (const double resolution : {0.05, 0.1, 0.025, 0.03}) {
    SCOPED_TRACE(resolution);
    const OccupancyGrid grid = smallMap(resolution);
    OccupancyGrid expected(resolution);
    for (int x = -300; x < 60; ++x)
      for (int y = -40; y < 80; ++y) {
        const double occupied = grid.occupancy({x, y});
        if (occupied > 0.65) expected.tiles().set({x, y}, kOccupied);
        if (occupied < 0.5) expected.tiles().set({x, y}, kFree);
      }
    saveRosMap(folder, toMrpt(grid), {});
    expectSameCells(readMap(folder.path("map.yaml")), expected);
  }
}

TEST_F(MapReader, FilesThatAreNoMap) {
  EXPECT_THAT(errorOf(root.path("none.yaml")), HasSubstr("no such file"));
  EXPECT_THAT(errorOf(root.path("")), HasSubstr("not a file"));
  for (const std::string content :
       {"", "1000 0 0 0 0 0 0 1\n", "{", "a: [b", "- a\n- b\n", "\x89PNG\r\n\x1a\n"}) {
    SCOPED_TRACE(content);
    const std::string file = root.write("map", content);
    EXPECT_THAT(errorOf(file), AllOf(HasSubstr("map"), HasSubstr(file), HasSubstr("; expected ")));
  }
}

TEST_F(MapReader, AGridMapThatIsCutOrHasImpossibleCells) {
  saveGridMap(folder, toMrpt(smallMap()));
  const std::string bytes = test::contentOf(folder.path("map.gridmap.gz"));
  const std::string file = root.write("map.gridmap.gz", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(errorOf(file), AllOf(HasSubstr("cut off"), HasSubstr(file)));
  mrpt::maps::COccupancyGridMap2D coarse(0, 400, 0, 400, 20);
  saveGridMap(folder, coarse);
  EXPECT_THAT(errorOf(folder.path("map.gridmap.gz")), HasSubstr("expected 0.001 .. 10 m per cell"));
}

}  // namespace
}  // namespace hybrid_slam::run
