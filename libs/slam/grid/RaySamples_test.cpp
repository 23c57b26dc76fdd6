#include "slam/grid/RaySamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

TEST(RaySamples, TheCellsMatchTheExactPositions) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 500; ++i) {
    // On both sides of the origin, and a hundred kilometres away.
    const double far = i % 2 == 0 ? 40 : 4e6;
    const double x = far * (random.uniform() - 0.5), y = far * (random.uniform() - 0.5);
    const double heading = 2 * M_PI * random.uniform(), dx = std::cos(heading), dy = std::sin(heading);
    RaySamples place(x, y, dx, dy);
    for (int k = 0; k < 400; ++k, place.advance()) {
      const double atX = x + k * dx, atY = y + k * dy;
      constexpr double kRounding = 1e-6;  // 400 steps of 2^-32, and that of far away doubles
      const double borderX = std::abs(atX - std::round(atX)), borderY = std::abs(atY - std::round(atY));
      if (std::min(borderX, borderY) < kRounding) continue;
      ASSERT_EQ(place.cellX(), std::floor(atX));
      ASSERT_EQ(place.cellY(), std::floor(atY));
      ASSERT_EQ(place.squareX(), std::floor(place.cellX() / 8.0));
      ASSERT_EQ(place.squareY(), std::floor(place.cellY() / 8.0));
    }
  }
}

TEST(RaySamples, AheadEqualsAdvance) {
  RaySamples place(-3.3, 7.7, -0.8, 0.6);
  const RaySamples ahead = place.ahead(7);
  for (int i = 0; i < 7; ++i) place.advance();
  EXPECT_EQ(place.cellX(), ahead.cellX());
  EXPECT_EQ(place.cellY(), ahead.cellY());
  EXPECT_EQ(place.cellX(), -9);  // -8.9
  EXPECT_EQ(place.cellY(), 11);  // 11.9
}

TEST(RaySamples, AlongTheAxesAndFromBorders) {
  RaySamples right(2, -1, 1, 0), down(-0.5, 0, 0, -1);
  for (int k = 0; k < 5; ++k, right.advance(), down.advance()) {
    EXPECT_EQ(right.cellX(), 2 + k);
    EXPECT_EQ(right.cellY(), -1);
    EXPECT_EQ(down.cellX(), -1);
    EXPECT_EQ(down.cellY(), -k);
  }
}

}  // namespace
}  // namespace hybrid_slam
