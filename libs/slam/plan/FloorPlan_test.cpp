#include "slam/plan/FloorPlan.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "slam/plan/WallLines.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr double kCell = 0.05;

/// Walls drawn into free space.
struct PaintedGrid {
  OccupancyGrid grid{0.05};

  void paint(double x0, double y0, double x1, double y1, int8_t value) {
    const CellIndex low = grid.cellOf(x0, y0), high = grid.cellOf(x1 - 1e-6, y1 - 1e-6);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) grid.tiles().set({x, y}, value);
  }
  void free(double x0, double y0, double x1, double y1) { paint(x0, y0, x1, y1, -20); }
  void unknown(double x0, double y0, double x1, double y1) { paint(x0, y0, x1, y1, 0); }
  void wall(double x0, double y0, double x1, double y1) { paint(x0, y0, x1, y1, 30); }
  /// Draws a wall of one cell along any line.
  void slantedWall(double x0, double y0, double x1, double y1) {
    const int steps = static_cast<int>(std::hypot(x1 - x0, y1 - y0) / 0.01);
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      grid.tiles().set(grid.cellOf(x0 + t * (x1 - x0), y0 + t * (y1 - y0)), 30);
    }
  }
};

DatabaseLine line(double x0, double y0, double x1, double y1, int count = 20) {
  DatabaseLine result;
  static_cast<LineSegment&>(result) = makeSegment({x0, y0}, {x1, y1});
  result.count = count;
  return result;
}

TEST(FloorPlan, AnEmptyMapGivesAnEmptyPlan) {
  EXPECT_TRUE(floorPlanOf({}, OccupancyGrid()).walls.empty());
  EXPECT_TRUE(floorPlanOf({line(0, 0, 10, 0)}, OccupancyGrid()).walls.empty());
  PaintedGrid free;
  free.free(-5, -5, 5, 5);
  EXPECT_TRUE(floorPlanOf({line(0, 0, 4, 0)}, free.grid).walls.empty());
}

// A corridor's wall with a room behind it: the line of the database crosses the door.
TEST(FloorPlan, TwoPiecesOfALineKeepTheDoorBetweenThem) {
  PaintedGrid map;
  map.free(0, -2, 7, 2);
  map.wall(0, 0, 3, kCell);
  map.wall(4, 0, 7, kCell);
  const FloorPlan plan = floorPlanOf({line(0, 0.02, 7, 0.02)}, map.grid);
  ASSERT_EQ(plan.walls.size(), 2u);
  EXPECT_EQ(plan.walls[0].group, plan.walls[1].group);
  ASSERT_EQ(plan.openings.size(), 1u);
  const auto [a, b] = plan.openings[0];
  EXPECT_NEAR(std::min(a.x, b.x), 3, kCell);
  EXPECT_NEAR(std::max(a.x, b.x), 4, kCell);
  for (const PlanWall& wall : plan.walls) {
    EXPECT_NEAR(wall.length(), 3, 2 * kCell);
    EXPECT_NEAR(wall.start.y, 0.022, 0.005);
    EXPECT_NEAR(wall.end.y, 0.022, 0.005);
    EXPECT_EQ(wall.count, 20);
    EXPECT_TRUE(wall.isSnapped);
  }
}

TEST(FloorPlan, AGapThatIsNotFreeIsClosed) {
  PaintedGrid map;
  map.free(0, -2, 7, 0);
  map.wall(0, 0, 3, kCell);
  map.wall(3.4, 0, 7, kCell);
  map.unknown(3, -1, 3.4, 0.5);
  const FloorPlan plan = floorPlanOf({}, map.grid);
  ASSERT_EQ(plan.walls.size(), 1u);
  EXPECT_NEAR(plan.walls[0].length(), 7, 2 * kCell);
}

// The mouth of an alcove is not a door.
TEST(FloorPlan, AnAlcoveIsNoOpening) {
  PaintedGrid map;
  map.free(0, -2, 7, 0.3);
  map.wall(0, 0, 3, 0.3);
  map.wall(4, 0, 7, 0.3);
  map.wall(3, 0.2, 4, 0.3);
  EXPECT_TRUE(floorPlanOf({}, map.grid).openings.empty());
}

TEST(FloorPlan, TheTwoFacesOfAWallArePaired) {
  PaintedGrid map;
  map.free(0, -2, 5, 2);
  map.wall(0, 0, 5, kCell);
  map.wall(0, 0.15, 5, 0.15 + kCell);
  map.unknown(0, kCell, 5, 0.15);
  const FloorPlan plan = floorPlanOf({}, map.grid);
  ASSERT_EQ(plan.walls.size(), 2u);
  EXPECT_EQ(plan.walls[0].pair, 1);
  EXPECT_EQ(plan.walls[1].pair, 0);
  for (const PlanWall& wall : plan.walls) {
    EXPECT_NEAR(wall.thickness, 0.15, 0.005);
    EXPECT_NEAR(wall.length(), 5, 2 * kCell);
    // The free side is on the left.
    EXPECT_GT((wall.end.x - wall.start.x) * (wall.start.y - 0.1), 0);
  }
}

/// Returns whether an end of a wall along x and one of a wall along y coincide.
bool hasCorner(const FloorPlan& plan) {
  for (const PlanWall& a : plan.walls)
    for (const PlanWall& b : plan.walls)
      for (const TPoint2D& p : {a.start, a.end})
        for (const TPoint2D& q : {b.start, b.end})
          if (std::abs(std::sin(a.line.angle - b.line.angle)) > 0.9 && (p - q).norm() < 1e-6) return true;
  return false;
}

TEST(FloorPlan, AnOpenCornerIsClosedUnlessTheGridIsFreeThere) {
  PaintedGrid map;
  map.free(0, 0, 4, 4);
  map.wall(0.2, -kCell, 4, 0);
  map.wall(-kCell, 0.2, 0, 4);
  const FloorPlan closed = floorPlanOf({}, map.grid);
  ASSERT_EQ(closed.walls.size(), 2u);
  EXPECT_TRUE(hasCorner(closed));

  map.free(-1, -1, 0.2, 0.2);
  EXPECT_FALSE(hasCorner(floorPlanOf({}, map.grid)));
}

// A wall takes the building's direction only as far as its own covariance allows.
TEST(FloorPlan, AShortSlantedWallTakesTheBuildingsDirection) {
  PaintedGrid map;
  map.free(0, 0, 12, 12);
  map.wall(0, 0, 12, kCell);
  map.wall(0, 0, kCell, 12);
  map.slantedWall(5, 5, 5.7, 5.02);
  map.wall(5, 4.4, 5.05, 5);  // or the short one is clutter
  const FloorPlan plan = floorPlanOf({}, map.grid);
  ASSERT_EQ(plan.directions.size(), 1u);
  EXPECT_NEAR(plan.directions[0], 0, 1e-3);
  int shortOnes = 0;
  for (const PlanWall& wall : plan.walls) {
    const TPoint2D middle = (wall.start + wall.end) * 0.5;
    if (std::abs(middle.y - 5) < 0.1 && wall.length() > 0.5) {
      ++shortOnes;
      EXPECT_TRUE(wall.isSnapped);
      EXPECT_NEAR(std::sin(wall.line.angle), 0, 1e-3);
    }
  }
  EXPECT_GE(shortOnes, 1);
}

// It is too far off the building's direction, and too short for one of its own.
TEST(FloorPlan, ALongSlantedWallKeepsItsDirection) {
  const double angle = 20 * M_PI / 180;
  PaintedGrid map;
  map.free(0, 0, 12, 12);
  map.wall(0, 0, 12, kCell);
  map.wall(0, 0, kCell, 12);
  map.slantedWall(4, 5, 4 + 2 * std::cos(angle), 5 + 2 * std::sin(angle));
  const FloorPlan plan = floorPlanOf({}, map.grid);
  ASSERT_EQ(plan.directions.size(), 1u);
  EXPECT_NEAR(plan.directions[0], 0, 1e-3);
  int slanted = 0, straight = 0;
  for (const PlanWall& wall : plan.walls) {
    if (wall.length() > 10) {
      ++straight;
      EXPECT_TRUE(wall.isSnapped);
    } else if (wall.length() > 1.5) {
      ++slanted;
      EXPECT_FALSE(wall.isSnapped);
      EXPECT_NEAR(std::sin(wall.line.angle - angle), 0, 0.05);
    }
  }
  EXPECT_GE(straight, 2);
  EXPECT_GE(slanted, 1);
}

TEST(FloorPlan, AnyMapGivesAPlanOfFiniteWalls) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 20), angle(-M_PI, M_PI), length(0.1, 8);
    PaintedGrid map;
    map.free(-1, -1, 21, 21);
    std::vector<DatabaseLine> lines;
    for (int i = 0; i < 40; ++i) {
      const double x = place(random), y = place(random), phi = angle(random), l = length(random);
      const double x1 = x + l * std::cos(phi), y1 = y + l * std::sin(phi);
      if (i % 3 != 0) map.slantedWall(x, y, x1, y1);
      if (i % 2 == 0) lines.push_back(line(x, y, x1, y1, 1 + i));
    }
    const FloorPlan plan = floorPlanOf(lines, map.grid);
    EXPECT_GT(plan.walls.size(), 10u);
    for (size_t i = 0; i < plan.walls.size(); ++i) {
      const PlanWall& wall = plan.walls[i];
      for (const TPoint2D& p : {wall.start, wall.end}) {
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
        ASSERT_LT(std::hypot(p.x - 10, p.y - 10), 30);
        ASSERT_NEAR(wall.line.offset(p), 0, 1e-6);
      }
      ASSERT_GT(wall.length(), 0);
      ASSERT_GT(wall.line.covariance(0, 0), 0);
      ASSERT_GT(wall.line.covariance.determinant(), 0);
      if (wall.pair >= 0) {
        ASSERT_EQ(plan.walls.at(static_cast<size_t>(wall.pair)).pair, static_cast<int>(i));
        ASSERT_GT(wall.thickness, 0);
      }
    }
  }
}

Face face(const TPoint2D& start, const TPoint2D& end) {
  Face result;
  result.start = start, result.end = end;
  const TPoint2D d = end - start;
  result.line = lineThrough((start + end) * 0.5, std::atan2(d.y, d.x), d.norm(), 0.01);
  return result;
}

TEST(FloorPlan, ThereIsNoDoorBetweenPiecesOfClutter) {
  PaintedGrid map;
  map.free(-2, -2, 4, 2);
  map.wall(0, 0, 0.6, kCell);
  map.wall(1.15, 0, 1.75, kCell);
  const FloorPlan plan = floorPlanOf({}, map.grid);
  EXPECT_TRUE(plan.walls.empty());
  EXPECT_TRUE(plan.openings.empty());
}

TEST(WallLines, TheStretchesOfADatabaseLineCountOnce) {
  const auto faceOf = [](const LineEstimate& line, double from, double to) {
    Face face;
    face.start = {from, 0}, face.end = {to, 0};
    face.line = line;
    face.count = 20;
    return face;
  };
  const LineEstimate a = lineThrough({5, 0}, 0, 10, 0.004), b = lineThrough({15, 0}, 0, 8, 0.004);
  const std::vector<WallLine> groups =
      wallLinesOf({faceOf(a, 0, 10), faceOf(b, 11, 14), faceOf(b, 15, 17), faceOf(b, 17.5, 19)}, kCell);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_LT((groups[0].line.covariance - fused(a, b).covariance).norm(), 1e-12);
}

TEST(WallLines, TwoImagesOfAWallAreOneLine) {
  const Face wall = face({0, 0}, {10, 0});
  EXPECT_EQ(wallLinesOf({wall, face({1, 0.035}, {8, 0.045})}, kCell).size(), 1u)
      << "too far for their covariances";
  EXPECT_EQ(wallLinesOf({wall, face({8, 0.045}, {1, 0.035})}, kCell).size(), 2u) << "its other side";
  EXPECT_EQ(wallLinesOf({wall, face({1, 0.1}, {8, 0.1})}, kCell).size(), 2u) << "another wall";
  EXPECT_EQ(wallLinesOf({wall, face({9, 0.045}, {16, 0.045})}, kCell).size(), 2u)
      << "it goes on with an offset";
}

TEST(WallLines, WhatIsBeyondADoorMovesWithItsDouble) {
  const Face wall = face({0, 0}, {10, 0}), image = face({4, 0.04}, {9, 0.04}),
             beyond = face({10, 0.04}, {11, 0.04});
  const auto groups = wallLinesOf({wall, image, beyond}, kCell);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].faces.size(), 3u);
}

// This would take minutes if the number of comparisons grew quadratically.
TEST(WallLines, AHundredThousandFacesAreGrouped) {
  std::vector<Face> faces;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1000), angle(-M_PI, M_PI);
  for (int i = 0; i < 100'000; ++i) {
    const TPoint2D p(place(random), place(random));
    const double phi = angle(random);
    faces.push_back(face(p, p + TPoint2D(std::cos(phi), std::sin(phi))));
  }
  EXPECT_GT(wallLinesOf(faces, kCell).size(), 90'000u);
  EXPECT_EQ(wallLinesOf(std::vector<Face>(100'000, faces[0]), kCell).size(), 1u);
}

}  // namespace
}  // namespace hybrid_slam
