#include "run/MapFiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>

#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using mrpt::img::TColor;
using mrpt::maps::COccupancyGridMap2D;

/// A room of 4 m x 2 m from (1, -3) on, its walls one cell thick, free inside, nothing known outside.
COccupancyGridMap2D roomGrid(float cell) {
  COccupancyGridMap2D grid;
  grid.setSize(-2, 8, -6, 4, cell, 0.5f);
  const auto fill = [&grid](double x0, double y0, double x1, double y1, float free) {
    for (int x = grid.x2idx(x0); x <= grid.x2idx(x1); ++x)
      for (int y = grid.y2idx(y0); y <= grid.y2idx(y1); ++y) grid.setCell(x, y, free);
  };
  const double inside = 1.2 * cell, middle = 0.5 * cell;
  fill(1 + middle, -3 + middle, 5 + middle, -1 + middle, 0.03f);
  fill(1 + middle + inside, -3 + middle + inside, 5 + middle - inside, -1 + middle - inside, 0.97f);
  return grid;
}

class MapFiles : public testing::Test {
 protected:
  files::TemporaryFolder root;
  files::OutputFolder folder{root.path("out")};
};

TEST_F(MapFiles, RosMapRoundTripForEveryCellSize) {
  for (const float cell : {0.05f, 0.1f, 0.025f, 0.0125f, 0.03f}) {
    SCOPED_TRACE(cell);
    const COccupancyGridMap2D grid = roomGrid(cell);
    saveRosMap(folder, grid);
    const auto back = COccupancyGridMap2D::FromROSMapServerYAML(folder.path("map.yaml"));
    EXPECT_FLOAT_EQ(back.getResolution(), cell);
    size_t occupied = 0;
    for (int x = 0; x < static_cast<int>(grid.getSizeX()); ++x)
      for (int y = 0; y < static_cast<int>(grid.getSizeY()); ++y) {
        const float expected = grid.getCell(x, y) < 0.3f ? 0 : grid.getCell(x, y) > 0.7f ? 1 : 0.5f;
        const float read = back.getPos(static_cast<float>(grid.idx2x(x)), static_cast<float>(grid.idx2y(y)));
        ASSERT_NEAR(read, expected, 0.02) << grid.idx2x(x) << ' ' << grid.idx2y(y);
        occupied += expected == 0 ? 1 : 0;
      }
    EXPECT_GT(occupied, 4 * 4 / cell * 0.5);
  }
}

TEST_F(MapFiles, RosMapIsValidForMapServer) {
  saveRosMap(folder, roomGrid(0.05f));
  EXPECT_EQ(test::contentOf(folder.path("map.yaml")),
            "image: map.pgm\nresolution: 0.05\norigin: [0.5, -3.5, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
            "free_thresh: 0.196\n");
  const std::string pgm = test::contentOf(folder.path("map.pgm"));
  const std::string header = "P5\n101 61\n255\n";
  ASSERT_EQ(pgm.substr(0, header.size()), header);
  ASSERT_EQ(pgm.size(), header.size() + 101 * 61);
  const auto pixel = [&](size_t x, size_t y) {
    return static_cast<int>(static_cast<unsigned char>(pgm[header.size() + y * 101 + x]));
  };
  EXPECT_EQ(pixel(0, 0), 205);    // unknown
  EXPECT_EQ(pixel(50, 10), 0);    // the northern wall, ten cells below the edge
  EXPECT_EQ(pixel(50, 50), 0);    // the southern wall
  EXPECT_EQ(pixel(50, 30), 254);  // inside
}

TEST_F(MapFiles, GridMapRoundTrip) {
  const COccupancyGridMap2D grid = roomGrid(0.05f);
  saveGridMap(folder, grid);
  mrpt::io::CFileGZInputStream in(folder.path("map.gridmap.gz"));
  COccupancyGridMap2D back;
  mrpt::serialization::archiveFrom(in) >> back;
  EXPECT_EQ(back.getResolution(), grid.getResolution());
  EXPECT_EQ(back.getXMin(), grid.getXMin());
  EXPECT_EQ(back.getYMax(), grid.getYMax());
  EXPECT_EQ(back.getRawMap(), grid.getRawMap());
}

/// The picture's scale and place come from its size: the known window and ten cells around it.
class Picture : public MapFiles {
 protected:
  void load() { ASSERT_TRUE(image.loadFromFile(folder.path("map.png"))); }
  TColor at(double x, double y) const {
    const double scale = static_cast<double>(image.getWidth()) / 101 / 0.05;
    const auto column = static_cast<unsigned>((x - 0.5) * scale);
    const auto row = static_cast<unsigned>((-0.45 - y) * scale);
    return {*image.ptr<uint8_t>(column, row, 2), *image.ptr<uint8_t>(column, row, 1),
            *image.ptr<uint8_t>(column, row, 0)};
  }
  mrpt::img::CImage image;
};

TEST_F(Picture, WallsPathLinesAndRobotAreWhereTheyShouldBe) {
  const files::Trajectory path{{0, {1.5, -2, 0}}, {1, {4, -2, 0}}};
  DatabaseLine line;
  line.start = {1.2, -1.5}, line.end = {4.8, -1.5};
  savePicture(folder, roomGrid(0.05f), path, {line});
  load();
  ASSERT_EQ(image.getWidth() % 101, 0u);
  EXPECT_EQ(image.getHeight() * 101, image.getWidth() * 61);
  const auto isGrey = [](const TColor& c, int low, int high) {
    return c.R == c.G && c.G == c.B && c.R >= low && c.R <= high;
  };
  for (const auto& [x, y] : {std::pair(1.025, -2.2), {5.025, -2.2}, {3., -2.975}, {3., -0.975}})
    EXPECT_TRUE(isGrey(at(x, y), 0, 20)) << "wall at " << x << ' ' << y;
  EXPECT_TRUE(isGrey(at(3, -2.5), 240, 255)) << "free inside";
  EXPECT_TRUE(isGrey(at(0.7, -2), 120, 135)) << "unknown outside";
  const TColor red = at(2.5, -2), green = at(3, -1.5), blue = at(4.25, -2);
  EXPECT_TRUE(red.R > 200 && red.G < 50 && red.B < 50);
  EXPECT_TRUE(green.G > 100 && green.R < 50 && green.B < 50);
  EXPECT_TRUE(blue.B > 200 && blue.R < 150) << "the robot is at the end of its path and looks along x";
}

TEST_F(Picture, OfAnUnknownMap) {
  COccupancyGridMap2D grid;
  grid.setSize(0, 1, 0, 1, 0.05f, 0.5f);
  savePicture(folder, grid, {}, {});
  saveRosMap(folder, grid);
  load();
  EXPECT_GT(image.getWidth(), 0u);
}

TEST_F(Picture, OfALargeMapIsReducedAndKeepsThinWalls) {
  COccupancyGridMap2D grid;
  grid.setSize(0, 1200, 0, 600, 0.05f, 0.5f);  // 24,000 x 12,000 cells
  for (int x = 1; x < 23999; ++x) grid.setCell(x, 6001, 0.03f);
  grid.setCell(0, 0, 0.9f), grid.setCell(23999, 11999, 0.9f);
  savePicture(folder, grid, {{0, {300, 100, 0}}, {1, {900, 100, 0}}}, {});
  load();
  ASSERT_EQ(image.getWidth(), 8000u);
  ASSERT_EQ(image.getHeight(), 4000u);
  const auto pixel = [this](unsigned x, unsigned y) {
    return static_cast<int>(*image.ptr<uint8_t>(x, y, 0));
  };
  for (const unsigned x : {10u, 3333u, 7990u}) EXPECT_LT(pixel(x, 1999), 20) << "the wall";
  EXPECT_NEAR(pixel(3333, 1000), 127, 2) << "unknown";
  EXPECT_EQ(pixel(4000, 4000 - 667), 0) << "the path";
}

TEST_F(MapFiles, LinesAsDocumented) {
  DatabaseLine line;
  line.rho = 1.5, line.theta = 0.25, line.length = 2, line.start = {1, 2}, line.end = {3, 4}, line.count = 7;
  saveLines(folder, {line});
  EXPECT_EQ(test::contentOf(folder.path("lines.csv")),
            "rho,theta,length,x_start,y_start,x_end,y_end,count\n1.5,0.25,2,1,2,3,4,7\n");
  saveLines(folder, {});
  EXPECT_EQ(test::contentOf(folder.path("lines.csv")),
            "rho,theta,length,x_start,y_start,x_end,y_end,count\n");
}

}  // namespace
}  // namespace hybrid_slam::run
