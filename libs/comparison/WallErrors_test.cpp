#include "comparison/WallErrors.h"

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <cmath>
#include <functional>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// A corridor of 20 m x 3 m with its four walls.
const FloorPlan& corridor() {
  static const FloorPlan plan({Wall::straight({0, 0}, {20, 0}), Wall::straight({20, 0}, {20, 3}),
                               Wall::straight({20, 3}, {0, 3}), Wall::straight({0, 3}, {0, 0})});
  return plan;
}

/// A map whose frame lies at `frame` in the plan's.
struct Map {
  COccupancyGridMap2D grid{-5.f, 25.f, -8.f, 8.f, 0.05f};
  TPose2D frame;

  void mark(const TPoint2D& inPlan) {
    const TPoint2D p = (TPose2D() - frame).composePoint(inPlan);
    grid.setCell(grid.x2idx(p.x), grid.y2idx(p.y), 0.1f);
  }
  /// Every wall of the plan, each of its points moved by `shift`.
  void draw(const FloorPlan& plan, const std::function<TPoint2D(TPoint2D)>& shift) {
    for (const Wall& wall : plan.walls())
      for (double way = 0; way <= wall.length(); way += 0.02) mark(shift(wall.pointAt(way / wall.length())));
  }
};

TPoint2D stay(TPoint2D p) { return p; }

TEST(WallErrors, ACleanMapIsWithinACellAndNothingIsDoubled) {
  for (uint64_t i = 0; i < 20; ++i) {
    RandomStream random(1, i, 0);
    Map map;
    map.frame = {random.uniform() - 0.5, random.uniform() - 0.5, 0.2 * random.gaussian()};
    map.draw(corridor(), stay);
    const WallErrors errors = wallErrors(map.grid, corridor(), map.frame);
    EXPECT_LT(errors.mean, 0.025);
    EXPECT_LT(errors.p95, 0.05 * std::sqrt(0.5) + 1e-3);
    EXPECT_EQ(errors.doubledShare, 0);
  }
}

TEST(WallErrors, NoiseOfASensorAndStrayCellsDoubleNothing) {
  Map map;
  RandomStream random(2, 0, 0);
  for (int pass = 0; pass < 5; ++pass)
    map.draw(corridor(),
             [&](TPoint2D p) { return p + TPoint2D(0.02 * random.gaussian(), 0.02 * random.gaussian()); });
  for (int i = 0; i < 20; ++i) map.mark({1 + 0.9 * i, 0.3 + 2.4 * random.uniform()});
  EXPECT_EQ(wallErrors(map.grid, corridor(), map.frame).doubledShare, 0);
}

TEST(WallErrors, AWallSeenTwiceSideBySideIsDoubledWhereItIs) {
  for (const double shift : {0.3, 0.5, 0.8, -0.3, -0.8}) {
    Map map;
    map.draw(corridor(), stay);
    for (double x = 5; x <= 10; x += 0.02) map.mark({x, shift});  // 5 m of the south wall, once more
    const WallErrors errors = wallErrors(map.grid, corridor(), map.frame);
    // Free-standing are the walls but for their outer 0.5 m: 2 x 19 m and 2 x 2 m.
    EXPECT_NEAR(errors.doubledShare, 5.0 / 42, 0.002) << shift;
  }
}

TEST(WallErrors, AWallSmearedWideCountsToo) {
  Map map;
  map.draw(corridor(), stay);
  for (double x = 5; x <= 10; x += 0.02)
    for (double y = 0; y <= 0.3; y += 0.02) map.mark({x, y});
  EXPECT_NEAR(wallErrors(map.grid, corridor(), map.frame).doubledShare, 5.0 / 42, 0.002);
}

TEST(WallErrors, AWallDrawnTwiceWithinTheMeasuresResolutionDoesNot) {
  Map map;
  map.draw(corridor(), stay);
  map.draw(corridor(), [](TPoint2D p) { return p + TPoint2D(0.1, 0.1); });
  EXPECT_EQ(wallErrors(map.grid, corridor(), map.frame).doubledShare, 0);
}

TEST(WallErrors, ABentMapIsWrongButNotDoubled) {
  Map map;
  const auto bend = [](TPoint2D p) { return p + TPoint2D(0, 0.002 * p.x * p.x); };  // 0.8 m at the far end
  map.draw(corridor(), bend);
  const WallErrors errors = wallErrors(map.grid, corridor(), map.frame);
  EXPECT_EQ(errors.doubledShare, 0);
  EXPECT_GT(errors.mean, 0.15);
  EXPECT_GT(errors.p95, 0.6);
}

TEST(WallErrors, BothFacesOfAThickWallAreNotDoubled) {
  std::vector<Wall> walls = corridor().walls();
  walls.push_back(Wall::straight({2, 3.15}, {18, 3.15}));  // the room behind begins there
  const FloorPlan plan(walls);
  Map map;
  map.draw(plan, stay);
  EXPECT_EQ(wallErrors(map.grid, plan, map.frame).doubledShare, 0);
}

TEST(WallErrors, DistancesByHand) {
  Map map;
  for (double x = 2; x < 18; x += 0.02) map.mark({x, 0.425});  // row centres at 0.425 m
  const WallErrors errors = wallErrors(map.grid, corridor(), map.frame);
  EXPECT_NEAR(errors.mean, 0.425, 1e-3);
  EXPECT_NEAR(errors.p95, 0.425, 1e-3);
  EXPECT_EQ(errors.doubledShare, 0);
}

TEST(WallErrors, AMapWithoutOccupiedCellsIsAnError) {
  const Map map;
  EXPECT_THROW(wallErrors(map.grid, corridor(), {}), std::runtime_error);
  EXPECT_THROW(loadGridMap("/nowhere/map.gridmap.gz"), std::runtime_error);
}

// The building of the experiments, seen once and, along the south corridor, once more 0.4 m off: the 14 m
// that the loop's route drives twice.
TEST(WallErrors, TheCsieBuildingsOverlapIsFound) {
  const FloorPlan plan = FloorPlan::load(SOURCE_DIR "/datasets/csie/csie.plan");
  Map map;
  map.grid.setSize(-2.f, 42.f, -2.f, 49.f, 0.05f);
  map.draw(plan, stay);
  EXPECT_EQ(wallErrors(map.grid, plan, map.frame).doubledShare, 0);
  for (double x = 6; x <= 20; x += 0.02) map.mark({x, 0.4});
  EXPECT_GT(wallErrors(map.grid, plan, map.frame).doubledShare, 0.02);
}

}  // namespace
}  // namespace hybrid_slam
