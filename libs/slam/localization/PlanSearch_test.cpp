#include "slam/localization/PlanSearch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/Errors.h"
#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

FilterConfiguration configuration() {
  FilterConfiguration result;
  result.filter.particles = 5;
  return result;
}

TEST(PlanSearch, APlanWithoutWallsOfAMetreIsRejected) {
  EXPECT_THROW(PlanSearch(configuration(), {}, {}), InputError);
  EXPECT_THROW(PlanSearch(configuration(), {{{0, 0}, {0.5, 0}}}, {}), InputError);
}

TEST(PlanSearch, APlanInMillimetresIsRejected) {
  EXPECT_THROW(PlanSearch(configuration(), {{{-1e6, 0}, {-1e6 + 2, 0}}, {{1e6, 0}, {1e6 + 2, 0}}}, {}),
               InputError);
  EXPECT_THROW(PlanSearch(configuration(), {{{0, 0}, {40'000, 0}}, {{0, 0}, {0, 47'000}}}, {}), InputError);
}

TEST(PlanSearch, WithoutScansNothingIsFound) {
  PlanSearch search(configuration(), {{{0, 0}, {8, 0}}, {{8, 0}, {8, 6}}}, {});
  search.process({0.5, 0, 0}, {});
  EXPECT_FALSE(search.found());
}

// A plan in its own frame, whose scale is 2 % off.
TEST(PlanSearch, FindsTheRobotAndTheScale) {
  const TPose2D frame(3, -2, 0.7);  // of the room in the plan
  std::vector<PlanLine> plan;
  for (const auto& wall : test::room())
    plan.push_back(
        {frame.composePoint(wall.first) * (1 / 1.02), frame.composePoint(wall.second) * (1 / 1.02)});
  PlanSearch search(configuration(), plan, {});
  RandomStream random(1, 0, 0);
  TPose2D at(3, 0.5, 0.4);
  for (int i = 0; i < 60 && !search.found(); ++i) {
    const TPose2D motion(0.2, 0, 0.3);
    at = at + motion;
    search.process(motion, {std::make_shared<mrpt::obs::CObservation2DRangeScan>(
                               test::observationOf(test::room(), at, random))});
  }
  ASSERT_TRUE(search.found());
  EXPECT_NEAR(search.found()->scale, 1.02, 0.005);
  const TPose2D expected = frame + at;
  EXPECT_NEAR(search.found()->pose.x, expected.x, 0.1);
  EXPECT_NEAR(search.found()->pose.y, expected.y, 0.1);
  EXPECT_NEAR(std::remainder(search.found()->pose.phi - expected.phi, 2 * M_PI), 0, 0.03);
  EXPECT_FALSE(search.found()->map.lines.lines().empty());
}

}  // namespace
}  // namespace hybrid_slam
