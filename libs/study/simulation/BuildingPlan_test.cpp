#include "study/simulation/BuildingPlan.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/RandomStream.h"

namespace hybrid_slam::simulation {
namespace {

using mrpt::math::TPoint2D;

std::vector<Wall> rectangle(double x0, double y0, double x1, double y1) {
  return {Wall::straight({x0, y0}, {x1, y0}), Wall::straight({x1, y0}, {x1, y1}),
          Wall::straight({x1, y1}, {x0, y1}), Wall::straight({x0, y1}, {x0, y0})};
}

/// Returns a random heading, every fourth time along an axis.
double randomHeading(RandomStream& random) {
  return random.uniform() < 0.25 ? std::floor(random.uniform() * 4) * M_PI / 2
                                 : random.uniform() * 2 * M_PI - M_PI;
}

TEST(BuildingPlan, RangesInARectangleAreExact) {
  const double width = 7.3, height = 4.1;
  const BuildingPlan plan(rectangle(0, 0, width, height));
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform() * width, y = random.uniform() * height, heading = randomHeading(random);
    const double c = std::cos(heading), s = std::sin(heading);
    const double expected =
        std::min((c > 0 ? width - x : x) / std::abs(c), (s > 0 ? height - y : y) / std::abs(s));
    const auto range = plan.castRay({x, y}, heading, 100);
    ASSERT_TRUE(range);
    EXPECT_NEAR(*range, expected, 1e-9) << x << " " << y << " " << heading;
  }
}

TEST(BuildingPlan, RangesInsideACircleAreExact) {
  const double radius = 3.7;
  const TPoint2D centre(-2, 5);
  const BuildingPlan plan({Wall::arc(centre, radius, 1, 2 * M_PI)});
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 20000; ++i) {
    const double r = radius * std::sqrt(random.uniform()) * 0.999, around = random.uniform() * 2 * M_PI;
    const double heading = randomHeading(random);
    const double along = r * std::cos(heading - around), across = r * std::sin(heading - around);
    const auto range =
        plan.castRay({centre.x + r * std::cos(around), centre.y + r * std::sin(around)}, heading, 100);
    ASSERT_TRUE(range);
    EXPECT_NEAR(*range, -along + std::sqrt(radius * radius - across * across), 1e-9);
  }
}

TEST(BuildingPlan, AnArcIsSeenOnlyWithinItsAngles) {
  // The arc reaches from -30 to 45 deg, across the wrap of the angle.
  const BuildingPlan plan({Wall::arc({0, 0}, 2, mrpt::DEG2RAD(330.0), mrpt::DEG2RAD(75.0))});
  for (double degrees = -179.5; degrees < 180; degrees += 1) {
    const auto range = plan.castRay({0, 0}, mrpt::DEG2RAD(degrees), 10);
    EXPECT_EQ(range.has_value(), degrees > -30 && degrees < 45) << degrees;
    if (range) {
      EXPECT_NEAR(*range, 2, 1e-12);
    }
  }
  // One ray enters through the open side and meets the inside of the arc, the other meets its back.
  EXPECT_NEAR(plan.castRay({-5, 0}, 0, 20).value(), 7, 1e-12);
  EXPECT_NEAR(plan.castRay({5, 0}, M_PI, 20).value(), 3, 1e-12);
}

TEST(BuildingPlan, NothingBeyondTheMaximumRange) {
  const BuildingPlan plan({Wall::straight({5, -1}, {5, 1})});
  EXPECT_FALSE(plan.castRay({0, 0}, 0, 4.999));
  EXPECT_TRUE(plan.castRay({0, 0}, 0, 5.001));
  EXPECT_FALSE(plan.castRay({0, 0}, M_PI, 100));
  EXPECT_FALSE(plan.castRay({0, 3}, 0, 100));
}

TEST(BuildingPlan, ARayAlongAWallMeetsItsNearerEnd) {
  const BuildingPlan plan({Wall::straight({5, 0}, {3, 0})});
  EXPECT_NEAR(plan.castRay({0, 0}, 0, 10).value(), 3, 1e-12);
  EXPECT_NEAR(plan.castRay({4, 0}, 0, 10).value(), 0, 1e-12);
  EXPECT_FALSE(plan.castRay({6, 0}, 0, 10));
}

TEST(BuildingPlan, NoRayEscapesThroughTheCornersOfAClosedRoom) {
  RandomStream random(3, 0, 0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<TPoint2D> corners;
    const int n = 3 + static_cast<int>(random.uniform() * 8);
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * (i + 0.8 * random.uniform()) / n;
      corners.emplace_back(10 + 4 * std::cos(angle), -3 + 4 * std::sin(angle));
    }
    std::vector<Wall> walls;
    for (int i = 0; i < n; ++i) walls.push_back(Wall::straight(corners[i], corners[(i + 1) % n]));
    const BuildingPlan plan(walls);
    TPoint2D inside(0, 0);  // the mean of a convex polygon's corners
    for (const TPoint2D& corner : corners) inside += corner * (1.0 / n);
    for (const TPoint2D& corner : corners) {
      const auto range = plan.castRay(inside, std::atan2(corner.y - inside.y, corner.x - inside.x), 100);
      ASSERT_TRUE(range);
      EXPECT_NEAR(*range, (corner - inside).norm(), 1e-6);
    }
  }
}

/// Walls of every length and direction, many along the axes and on the borders of the index's cells.
std::vector<Wall> randomWalls(RandomStream& random) {
  std::vector<Wall> walls;
  const double size = std::pow(10, random.uniform() * 3);  // 1 m to 1 km
  const int n = 1 + static_cast<int>(random.uniform() * 40);
  const auto coordinate = [&] {
    const double v = (random.uniform() - 0.5) * size;
    return random.uniform() < 0.5 ? std::round(v * 2) / 2 : v;
  };
  for (int i = 0; i < n; ++i) {
    TPoint2D a(coordinate(), coordinate()), b(coordinate(), coordinate());
    const double kind = random.uniform();
    if (kind < 0.3) b.x = a.x;
    if (kind > 0.7) b.y = a.y;
    if ((a - b).norm() < 1e-3) b.x += 1;
    if (random.uniform() < 0.3)
      walls.push_back(Wall::arc(a, 0.05 + random.uniform() * size / 4, random.uniform() * 7 - 3,
                                0.01 + random.uniform() * (2 * M_PI - 0.01)));
    else
      walls.push_back(Wall::straight(a, b));
  }
  return walls;
}

TEST(BuildingPlan, TheIndexAgreesWithABruteForceSearch) {
  RandomStream random(4, 0, 0);
  int hits = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const std::vector<Wall> walls = randomWalls(random);
    const BuildingPlan plan(walls);
    const TPoint2D extent = plan.upperRight() - plan.lowerLeft();
    for (int i = 0; i < 200; ++i) {
      // 1.5 times the extent of the walls, so that rays also start outside.
      const TPoint2D p(plan.lowerLeft().x + (2 * random.uniform() - 0.5) * extent.x,
                       plan.lowerLeft().y + (2 * random.uniform() - 0.5) * extent.y);
      const double heading = randomHeading(random), maxRange = random.uniform() * 3 * extent.norm();
      double nearest = std::numeric_limits<double>::infinity(), distance = nearest;
      for (const Wall& wall : walls) {
        nearest = std::min(nearest, rayDistance(wall, p, {std::cos(heading), std::sin(heading)}));
        distance = std::min(distance, wall.distance(p));
      }
      const auto range = plan.castRay(p, heading, maxRange);
      ASSERT_EQ(range.has_value(), nearest <= maxRange) << "trial " << trial << " ray " << i;
      if (range) {
        EXPECT_EQ(*range, nearest);
        ++hits;
      }
      EXPECT_EQ(plan.distanceToNearestWall(p), distance);
    }
  }
  EXPECT_GT(hits, 5000);
}

TEST(BuildingPlan, DistanceToAnArcCountsItsEnds) {
  const BuildingPlan plan({Wall::arc({0, 0}, 1, 0, M_PI / 2)});
  EXPECT_NEAR(plan.distanceToNearestWall({0, 0}), 1, 1e-12);
  EXPECT_NEAR(plan.distanceToNearestWall({2, 2}), std::sqrt(8) - 1, 1e-12);
  EXPECT_NEAR(plan.distanceToNearestWall({-3, 1}), 3, 1e-12);
  EXPECT_NEAR(plan.distanceToNearestWall({1, -2}), 2, 1e-12);
}

TEST(BuildingPlan, WithoutWallsNothingIsSeen) {
  const BuildingPlan plan({});
  EXPECT_FALSE(plan.castRay({0, 0}, 1, 1e6));
  EXPECT_EQ(plan.distanceToNearestWall({0, 0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hybrid_slam::simulation
