#include "grid/RayTraversal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

struct Crossing {
  int x, y;
  double entry, exit;
};

struct Ray {
  double x, y, dirX, dirY, length;
};

Ray ray(double x, double y, double heading, double length) {
  return {x, y, std::cos(heading), std::sin(heading), length};
}

std::vector<Crossing> cross(const Ray& r) {
  std::vector<Crossing> all;
  traverseRay(r.x, r.y, r.dirX, r.dirY, r.length, [&](int x, int y, double entry, double exit) {
    all.push_back({x, y, entry, exit});
    return true;
  });
  return all;
}

/// What must hold of any ray; cells are compared away from their borders by more than rounding.
void expectSound(const Ray& r) {
  constexpr double kRounding = 1e-9;
  const auto crossings = cross(r);
  ASSERT_FALSE(crossings.empty());
  EXPECT_EQ(crossings.front().entry, 0);
  EXPECT_EQ(crossings.back().exit, r.length);
  std::set<std::pair<int, int>> cells;
  double sum = 0;
  for (size_t i = 0; i < crossings.size(); ++i) {
    const Crossing& c = crossings[i];
    ASSERT_LT(c.entry, c.exit);  // a cell that is only touched is not crossed
    sum += c.exit - c.entry;
    EXPECT_TRUE(cells.insert({c.x, c.y}).second) << "crossed twice";
    if (i > 0) {
      const Crossing& before = crossings[i - 1];
      EXPECT_EQ(c.entry, before.exit);
      // Side by side; or corner to corner, where the ray goes through a corner.
      EXPECT_LE(std::max(std::abs(c.x - before.x), std::abs(c.y - before.y)), 1);
    }
    if (c.exit - c.entry < kRounding) continue;
    const double middle = 0.5 * (c.entry + c.exit);
    EXPECT_EQ(std::floor(r.x + middle * r.dirX), c.x);
    EXPECT_EQ(std::floor(r.y + middle * r.dirY), c.y);
  }
  EXPECT_NEAR(sum, r.length, 1e-9 * r.length);
  for (int i = 0; i < 3000; ++i) {
    const double t = r.length * (i + 0.5) / 3000, x = r.x + t * r.dirX, y = r.y + t * r.dirY;
    if (std::abs(x - std::round(x)) < kRounding || std::abs(y - std::round(y)) < kRounding) continue;
    EXPECT_TRUE(cells.count({static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))}));
  }
}

TEST(RayTraversal, RandomRays) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 500; ++i)
    expectSound(ray(40 * random.uniform() - 20, 40 * random.uniform() - 20, 2 * M_PI * random.uniform(),
                    60 * random.uniform() + 1e-3));
}

TEST(RayTraversal, AxisParallelRaysAnywhereInACell) {
  for (const double x : {0.0, 0.3, -2.0, -2.7})
    for (const double y : {0.0, 0.6, 5.0, -1.1})
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
        for (const double length : {0.2, 1.0, 7.4})
          expectSound({x, y, static_cast<double>(dx), static_cast<double>(dy), length});
}

TEST(RayTraversal, DiagonalRaysThroughCornersAndFromCorners) {
  const double d = std::sqrt(0.5);
  for (const double x : {0.0, 0.5, -3.0, 0.25})
    for (const double y : {0.0, 0.5, 2.0})
      for (const double dx : {d, -d})
        for (const double dy : {d, -d}) expectSound({x, y, dx, dy, 9.3});
}

TEST(RayTraversal, RandomRaysFromBordersAndCorners) {
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const double x = std::floor(20 * random.uniform() - 10), y = std::floor(20 * random.uniform() - 10);
    const double heading = 2 * M_PI * random.uniform(), length = 20 * random.uniform() + 1e-3;
    expectSound(ray(x, y, heading, length));
    expectSound(ray(x, y + random.uniform(), heading, length));
    expectSound(ray(x + random.uniform(), y, heading, length));
  }
}

TEST(RayTraversal, HandMadeRayInOrder) {
  // From (0.5, 0.5) with slope 1/2: x borders at 1, 2, 3; y = 1 at x = 1.5.
  const double norm = std::hypot(2, 1), perX = norm / 2;
  const auto crossings = cross({0.5, 0.5, 2 / norm, 1 / norm, 2 * perX});
  const std::vector<Crossing> expected = {{0, 0, 0, 0.5 * perX},
                                          {1, 0, 0.5 * perX, perX},
                                          {1, 1, perX, 1.5 * perX},
                                          {2, 1, 1.5 * perX, 2 * perX}};
  ASSERT_EQ(crossings.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(crossings[i].x, expected[i].x);
    EXPECT_EQ(crossings[i].y, expected[i].y);
    EXPECT_NEAR(crossings[i].entry, expected[i].entry, 1e-12);
    EXPECT_NEAR(crossings[i].exit, expected[i].exit, 1e-12);
  }
}

TEST(RayTraversal, ARayWithoutLengthCrossesNothing) { EXPECT_TRUE(cross(ray(0.5, 0.5, 1, 0)).empty()); }

TEST(RayTraversal, StopsWhenItIsTold) {
  int visits = 0;
  traverseRay(0.5, 0.5, 1, 0, 100, [&](int x, int, double, double) { return ++visits, x < 3; });
  EXPECT_EQ(visits, 4);
}

/// Cells that are not free, with how far the ray goes in each; free ones may be left out or not.
TEST(TraverseObstacles, MeetsTheSameObstaclesAsACellByCellWalk) {
  RandomStream random(7, 0, 0);
  size_t met = 0, freeCells = 0, freeVisited = 0;
  for (int world = 0; world < 30; ++world) {
    TileGrid grid;
    for (int y = -96; y < 96; ++y)  // free, unknown beyond, a few obstacles
      for (int x = -96; x < 96; ++x)
        grid.set({x, y},
                 static_cast<int8_t>(random.uniform() < 0.003 * world ? 1 + random.bits() % 100 : -5));
    TileReader cells(grid);
    for (int i = 0; i < 60; ++i) {
      Ray r = ray(60 * random.uniform() - 30, 60 * random.uniform() - 30,
                  i < 8 ? i * M_PI / 4 : 2 * M_PI * random.uniform(), 200 * random.uniform());
      if (i < 8) {  // along the axes and the diagonals, from a cell's border
        r.x = std::floor(r.x), r.y = std::floor(r.y);
        r.dirX = std::round(r.dirX), r.dirY = std::round(r.dirY);
        const double norm = std::hypot(r.dirX, r.dirY);
        r.dirX /= norm, r.dirY /= norm;
      }
      std::vector<std::pair<int, double>> expected, seen;  // value, length
      constexpr double kRounding = 1e-9;
      for (const Crossing& c : cross(r)) {
        const int value = grid.at({c.x, c.y});
        freeCells += value < 0;
        if (value >= 0 && c.exit - c.entry > kRounding) expected.push_back({value, c.exit - c.entry});
      }
      double last = 0;
      traverseObstacles(cells, r.x, r.y, r.dirX, r.dirY, r.length,
                        [&](int8_t value, double entry, double exit) {
                          EXPECT_GE(entry, last - kRounding);
                          last = exit;
                          freeVisited += value < 0;
                          if (value >= 0 && exit - entry > kRounding) seen.push_back({value, exit - entry});
                          return true;
                        });
      ASSERT_EQ(seen.size(), expected.size()) << world << " " << i;
      for (size_t k = 0; k < seen.size(); ++k) {
        ASSERT_EQ(seen[k].first, expected[k].first);
        ASSERT_NEAR(seen[k].second, expected[k].second, 1e-9);
      }
      met += seen.size();
    }
  }
  EXPECT_GT(met, 10000u);
  EXPECT_LT(freeVisited, freeCells);  // what it is for
}

TEST(TraverseObstacles, EndsWhereTheVisitSaysSo) {
  const TileGrid grid;
  TileReader cells(grid);
  int visits = 0;
  traverseObstacles(cells, 0.5, 0.5, 1, 0, 100, [&](int8_t, double, double) { return ++visits < 20; });
  EXPECT_EQ(visits, 20);
}

}  // namespace
}  // namespace hybrid_slam
