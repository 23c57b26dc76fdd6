#include "window/view/MapImage.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hybrid_slam::window {
namespace {

using mrpt::maps::COccupancyGridMap2D;

TEST(MapImage, APixelIsACell) {
  COccupancyGridMap2D grid(-2, 8, -6, 4, 0.1f);
  grid.setCell(50, 40, 0.02f), grid.setCell(53, 45, 0.98f);
  const MapImage image = mapImage(grid);
  ASSERT_EQ(image.width, 24);
  ASSERT_EQ(image.height, 26);
  EXPECT_NEAR(image.left, -2 + 4.0, 1e-6);
  EXPECT_NEAR(image.bottom, -6 + 3.0, 1e-6);
  EXPECT_NEAR(image.top(), -6 + 5.6, 1e-6);
  const auto at = [&](int x, int y) {
    return static_cast<int>(image.grey[static_cast<size_t>((25 - y) * 24 + x)]);
  };
  EXPECT_LT(at(10, 10), 10);
  EXPECT_GT(at(13, 15), 245);
  EXPECT_NEAR(at(0, 0), 127, 2);
}

TEST(MapImage, OfALargeMapAPixelIsTheMostOccupiedOfItsCells) {
  COccupancyGridMap2D grid(0, 900, 0, 2, 0.05f);  // 18,000 x 40 cells
  for (int x = 0; x < 18000; ++x) grid.setCell(x, 20, 0.02f), grid.setCell(x, 21, 0.98f);
  const MapImage image = mapImage(grid);
  ASSERT_EQ(image.width, 6000);
  EXPECT_NEAR(image.resolution, 0.15, 1e-6);
  EXPECT_NEAR(image.right(), 900, 1e-3);
  for (const size_t x : {size_t{0}, size_t{3001}, size_t{5999}}) {
    int darkest = 255;
    for (size_t y = 0; y < static_cast<size_t>(image.height); ++y)
      darkest = std::min<int>(darkest, image.grey[y * 6000 + x]);
    EXPECT_LT(darkest, 10);
  }
}

TEST(MapImage, OfAnUnknownMapIsEmpty) { EXPECT_EQ(mapImage({0, 1, 0, 1, 0.1f}).width, 0); }

TEST(MapImage, DescribesTheCellAtAPlace) {
  COccupancyGridMap2D grid(-2, 2, -2, 2, 0.1f);
  grid.setCell(25, 30, 0.02f);  // x 0.5 to 0.6, y 1 to 1.1
  grid.setCell(26, 30, 0.98f);
  grid.setCell(27, 30, 0.49f);
  const MapImage image = mapImage(grid);
  EXPECT_EQ(describeCell(image, 0.55, 1.05), "x 0.55 m, y 1.05 m: occupied 0.98");
  EXPECT_EQ(describeCell(image, 0.65, 1.05), "x 0.65 m, y 1.05 m: occupied 0.02");
  EXPECT_NE(describeCell(image, 0.75, 1.05), "x 0.75 m, y 1.05 m: unknown") << "seen, but undecided";
  EXPECT_EQ(describeCell(image, 0.55, 1.15), "x 0.55 m, y 1.15 m: unknown");
  EXPECT_EQ(describeCell(image, -100, 5), "x -100.00 m, y 5.00 m: unknown");
  EXPECT_EQ(describeCell({}, 1, 1), "x 1.00 m, y 1.00 m: unknown") << "an empty map";
}

}  // namespace
}  // namespace hybrid_slam::window
