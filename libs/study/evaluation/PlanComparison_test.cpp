#include "study/evaluation/PlanComparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hybrid_slam::evaluation {
namespace {

using Walls = std::vector<PlanLine>;
using mrpt::math::TPose2D;

/// An L of 8 m and 6 m, with a room.
Walls building() {
  return {{{0, 0}, {8, 0}}, {{8, 0}, {8, 2}}, {{8, 2}, {2, 2}},      {{2, 2}, {2, 6}},
          {{2, 6}, {0, 6}}, {{0, 6}, {0, 0}}, {{2, 3.5}, {0.5, 3.5}}};
}

TEST(PlanComparison, APlanAgreesWithItself) {
  const PlanErrors errors = comparePlans(building(), building(), {});
  EXPECT_NEAR(errors.truth, 29.5, 1e-9);
  EXPECT_NEAR(errors.plan, 29.5, 1e-9);
  EXPECT_EQ(errors.found, 100);
  EXPECT_EQ(errors.wrong, 0);
  EXPECT_NEAR(errors.medianDistance, 0, 1e-12);
  EXPECT_FALSE(errors.foundOfSeen);
}

TEST(PlanComparison, DistanceAndAngleAreThoseOfTheWalls) {
  const Walls truth{{{0, 0}, {4, 0}}};
  const PlanErrors beside = comparePlans({{{0, 0.05}, {4, 0.05}}}, truth, {});
  EXPECT_NEAR(beside.medianDistance, 0.05, 1e-9);
  EXPECT_EQ(beside.found, 100);
  const PlanErrors turned = comparePlans(moved(truth, TPose2D(0, 0, 0.01)), truth, {});
  EXPECT_NEAR(turned.medianAngle, 0.01, 1e-9);
  EXPECT_NEAR(turned.medianDistance, 0.02, 1e-3);
}

TEST(PlanComparison, MissingAndFalseWallsCountByLength) {
  const Walls truth{{{0, 0}, {4, 0}}};
  const PlanErrors errors = comparePlans({{{0, 0}, {1.9, 0}}, {{0, 1}, {1.9, 1}}}, truth, {});
  EXPECT_NEAR(errors.found, 50, 0.6);  // the end reaches 0.1 m further
  EXPECT_NEAR(errors.wrong, 50, 0.6);
  EXPECT_EQ(comparePlans({{{2, -2}, {2, 2}}}, truth, {}).found, 0);  // another direction
  EXPECT_EQ(comparePlans({}, truth, {}).found, 0);
  EXPECT_EQ(comparePlans({}, truth, {}).wrong, 0);
}

TEST(PlanComparison, ManyShortWallsCountByLength) {
  Walls truth{{{0, 0}, {10, 0}}};
  for (int i = 0; i < 500; ++i) truth.push_back({{0.1 * i, 5}, {0.1 * i + 0.002, 5}});  // 1 m
  EXPECT_NEAR(comparePlans({{{0, 0}, {10, 0}}}, truth, {}).found, 100 * 10 / 11., 0.2);
}

TEST(PlanComparison, OnlyWhatTheLaserSawMustBeFound) {
  std::vector<mrpt::math::TPoint2D> ends;
  for (int i = 0; i < 300; ++i) ends.emplace_back(i * 0.01, 0.01);  // 3 of 8 m
  const PlanErrors errors = comparePlans({{{0, 0}, {3, 0}}}, {{{0, 0}, {8, 0}}}, ends);
  EXPECT_NEAR(errors.seen, 3, 0.05);
  EXPECT_EQ(errors.foundOfSeen, 100);
  EXPECT_NEAR(errors.found, 100 * 3.1 / 8, 0.6);
}

TEST(PlanComparison, AlignmentFindsAnyRigidMotion) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-100, 100), angle(-M_PI, M_PI);
  for (int i = 0; i < 50; ++i) {
    const TPose2D motion(place(random), place(random), angle(random));
    const Walls plan = moved(building(), TPose2D() - motion);
    const TPose2D found = alignmentOf(plan, building());
    EXPECT_NEAR(found.x, motion.x, 1e-3);
    EXPECT_NEAR(found.y, motion.y, 1e-3);
    EXPECT_NEAR(std::remainder(found.phi - motion.phi, 2 * M_PI), 0, 1e-4);
  }
}

TEST(PlanComparison, AlignmentDoesNotDependOnTheOrigin) {
  const TPose2D motion(0.3, -0.2, 0.4), far(5'000'000, 1'000'000, 0);
  const Walls plan = moved(building(), TPose2D() - motion);
  const TPose2D found = alignmentOf(plan, moved(building(), far));
  EXPECT_NEAR(found.x, far.x + motion.x, 1e-3);
  EXPECT_NEAR(found.y, far.y + motion.y, 1e-3);
  EXPECT_NEAR(std::remainder(found.phi - motion.phi, 2 * M_PI), 0, 1e-4);
}

TEST(PlanComparison, EmptyPlansAlign) {
  EXPECT_EQ(alignmentOf({}, building()), TPose2D());
  EXPECT_EQ(alignmentOf(building(), {}), TPose2D());
}

}  // namespace
}  // namespace hybrid_slam::evaluation
