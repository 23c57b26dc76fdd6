#include "slam/localization/PlanFit.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

#include "slam/grid/ScanBeams.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

std::vector<TPoint2D> seen(const test::Walls& walls, const TPose2D& at, RandomStream& random) {
  std::vector<TPoint2D> points =
      ScanBeams(test::scanOf(walls, at, {0.2, 0, 0}, 361, 2 * M_PI, 0.01, random)).endPoints();
  points.erase(
      std::remove_if(points.begin(), points.end(), [](const TPoint2D& p) { return !(p.norm() < 30); }),
      points.end());
  return points;
}

std::vector<PlanLine> drawn(const test::Walls& walls, const TPose2D& frame, double scale) {
  std::vector<PlanLine> plan;
  for (const auto& wall : walls)
    plan.push_back(
        {frame.composePoint(wall.first) * (1 / scale), frame.composePoint(wall.second) * (1 / scale)});
  return plan;
}

TEST(PlanFit, FindsPoseAndScale) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 50; ++i) {
    const TPose2D frame(test::uniform(random, -200, 200), test::uniform(random, -200, 200),
                        test::uniform(random, -M_PI, M_PI));
    const TPose2D robot(test::uniform(random, 2, 4), test::uniform(random, 1, 3),
                        test::uniform(random, -M_PI, M_PI));
    const double scale = test::uniform(random, 0.97, 1.03);
    const TPose2D truth = frame + robot;
    PlanFit first;
    // The error of the first pose is one in the plan as drawn, whose origin is far away.
    first.pose = {truth.x / scale + test::uniform(random, -0.2, 0.2),
                  truth.y / scale + test::uniform(random, -0.2, 0.2),
                  truth.phi + mrpt::DEG2RAD(test::uniform(random, -2, 2))};
    const PlanFit fit = fitPlan(seen(test::room(), robot, random), drawn(test::room(), frame, scale), first);
    EXPECT_NEAR(fit.scale, scale, 0.005) << i;
    EXPECT_NEAR(
        std::hypot(fit.pose.x - truth.x * fit.scale / scale, fit.pose.y - truth.y * fit.scale / scale), 0,
        0.03);
    EXPECT_NEAR(std::remainder(fit.pose.phi - truth.phi, 2 * M_PI), 0, mrpt::DEG2RAD(0.3));
  }
}

// One wall shows no scale: it stays what is expected of plans, and so does the pose along the wall.
TEST(PlanFit, KeepsWhatNoPointShows) {
  RandomStream random(2, 0, 0);
  const test::Walls wall{{{-50, 1}, {50, 1}}};
  PlanFit first;
  first.pose = {3, 0.1, 0};
  const PlanFit fit = fitPlan(seen(wall, {0, 0, 0}, random), drawn(wall, {}, 1), first);
  EXPECT_NEAR(fit.scale, 1, 0.002);
  EXPECT_NEAR(fit.pose.x, 3, 0.1);
  EXPECT_NEAR(fit.pose.y, 0, 0.01);
}

// Furniture hides part of a wall, and one wall of the plan does not exist.
TEST(PlanFit, IsRobustAgainstFurnitureAndWrongWalls) {
  RandomStream random(3, 0, 0);
  test::Walls built = test::room(), plan = test::room();
  built.push_back({{3, 1.2}, {3.6, 1.2}});
  plan.push_back({{1, 3}, {2, 3}});
  const TPose2D robot(2.5, 2, 0.4);
  PlanFit first;
  first.pose = robot;
  const PlanFit fit = fitPlan(seen(built, robot, random), drawn(plan, {}, 1.02), first);
  EXPECT_NEAR(fit.scale, 1.02, 0.01);
}

TEST(PlanFit, WithoutWallsNearbyTheFirstPoseStays) {
  PlanFit first;
  first.pose = {3, 2, 1};
  const PlanFit fit = fitPlan({{1, 0}, {0, 1}}, {{{500, 500}, {510, 500}}}, first);
  EXPECT_NEAR(fit.pose.x, 3, 1e-9);
  EXPECT_NEAR(fit.scale, 1, 1e-9);
}

}  // namespace
}  // namespace hybrid_slam
