#include "run/MapFiles.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>

#include "files/TemporaryFolder.h"
#include "testing/PictureRoom.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using mrpt::maps::COccupancyGridMap2D;

class MapFiles : public testing::Test {
 protected:
  files::TemporaryFolder root;
  files::OutputFolder folder{root.path("out")};
};

TEST_F(MapFiles, RosMapRoundTripForEveryCellSize) {
  for (const float cell : {0.05f, 0.1f, 0.025f, 0.0125f, 0.03f}) {
    SCOPED_TRACE(cell);
    const COccupancyGridMap2D grid = test::pictureRoom(cell);
    saveRosMap(folder, grid, {});
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
  saveRosMap(folder, test::pictureRoom(0.05f), {});
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
  const COccupancyGridMap2D grid = test::pictureRoom(0.05f);
  saveGridMap(folder, grid);
  mrpt::io::CFileGZInputStream in(folder.path("map.gridmap.gz"));
  COccupancyGridMap2D back;
  mrpt::serialization::archiveFrom(in) >> back;
  EXPECT_EQ(back.getResolution(), grid.getResolution());
  EXPECT_EQ(back.getXMin(), grid.getXMin());
  EXPECT_EQ(back.getYMax(), grid.getYMax());
  EXPECT_EQ(back.getRawMap(), grid.getRawMap());
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
