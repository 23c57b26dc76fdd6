#include "study/comparison/WallErrors.h"

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <cmath>
#include <functional>

#include "base/RandomStream.h"

namespace hybrid_slam::comparison {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// A corridor of 20 m x 3 m with its four walls.
const simulation::BuildingPlan& corridor() {
  static const simulation::BuildingPlan plan(
      {simulation::Wall::straight({0, 0}, {20, 0}), simulation::Wall::straight({20, 0}, {20, 3}),
       simulation::Wall::straight({20, 3}, {0, 3}), simulation::Wall::straight({0, 3}, {0, 0})});
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
  void draw(const simulation::BuildingPlan& plan, const std::function<TPoint2D(TPoint2D)>& shift) {
    for (const simulation::Wall& wall : plan.walls())
      for (double way = 0; way <= wall.length(); way += 0.02) mark(shift(wall.pointAt(way / wall.length())));
  }
};

TPoint2D stay(TPoint2D p) { return p; }

TEST(WallErrors, ACleanMapIsWithinACell) {
  for (uint64_t i = 0; i < 20; ++i) {
    RandomStream random(1, i, 0);
    Map map;
    map.frame = {random.uniform() - 0.5, random.uniform() - 0.5, 0.2 * random.gaussian()};
    map.draw(corridor(), stay);
    const WallErrors errors = wallErrors(map.grid, corridor(), map.frame);
    EXPECT_LT(errors.mean, 0.025);
    EXPECT_LT(errors.p95, 0.05 * std::sqrt(0.5) + 1e-3);
  }
}

TEST(WallErrors, ABentMapIsFarOff) {
  Map map;
  const auto bend = [](TPoint2D p) { return p + TPoint2D(0, 0.002 * p.x * p.x); };  // 0.8 m at the far end
  map.draw(corridor(), bend);
  const WallErrors errors = wallErrors(map.grid, corridor(), map.frame);
  EXPECT_GT(errors.mean, 0.15);
  EXPECT_GT(errors.p95, 0.6);
}

TEST(WallErrors, DistancesByHand) {
  Map map;
  for (double x = 2; x < 18; x += 0.02) map.mark({x, 0.425});  // row centres at 0.425 m
  const WallErrors errors = wallErrors(map.grid, corridor(), map.frame);
  EXPECT_NEAR(errors.mean, 0.425, 1e-3);
  EXPECT_NEAR(errors.p95, 0.425, 1e-3);
}

TEST(WallErrors, AMapWithoutOccupiedCellsIsAnError) {
  const Map map;
  EXPECT_THROW(wallErrors(map.grid, corridor(), {}), std::runtime_error);
}

}  // namespace
}  // namespace hybrid_slam::comparison
