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

}  // namespace
}  // namespace hybrid_slam::window
