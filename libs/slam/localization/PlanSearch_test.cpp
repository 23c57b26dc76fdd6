#include "slam/localization/PlanSearch.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/Errors.h"
#include "testing/MappedRoom.h"
#include "testing/RingDrive.h"

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

// A search in it would block the filter for long; a given start needs none.
TEST(PlanSearch, ALargePlanNeedsAStart) {
  const std::vector<PlanLine> plan{{{0, 0}, {300, 0}}, {{0, 0}, {0, 300}}};
  EXPECT_THROW(PlanSearch(configuration(), plan, {}), InputError);
  EXPECT_NO_THROW(PlanSearch(configuration(), plan, TPose2D(1, 1, 0)));
}

TEST(PlanSearch, WithoutScansNothingIsFound) {
  PlanSearch search(configuration(), {{{0, 0}, {8, 0}}, {{8, 0}, {8, 6}}}, {});
  search.process({0.5, 0, 0}, {});
  EXPECT_FALSE(search.found());
}

/// Draws walls in a plan of its own frame, whose coordinates must be multiplied by `scale`.
std::vector<PlanLine> drawn(const test::Walls& walls, double scale, const TPose2D& frame = {3, -2, 0.7}) {
  std::vector<PlanLine> plan;
  for (const auto& wall : walls)
    plan.push_back(
        {frame.composePoint(wall.first) * (1 / scale), frame.composePoint(wall.second) * (1 / scale)});
  return plan;
}

void expectNear(const PlanSearch::Found& found, const TPose2D& expected) {
  EXPECT_NEAR(found.pose.x, expected.x, 0.1);
  EXPECT_NEAR(found.pose.y, expected.y, 0.1);
  EXPECT_NEAR(std::remainder(found.pose.phi - expected.phi, 2 * M_PI), 0, 0.03);
}

Scans roomScan(const TPose2D& at, RandomStream& random) {
  return {std::make_shared<mrpt::obs::CObservation2DRangeScan>(test::roomScan(at, random))};
}

/// Drives circles in the room until the robot is found. @return its true pose then
TPose2D circle(PlanSearch& search) {
  RandomStream random(1, 0, 0);
  TPose2D at(3, 0.5, 0.4);
  for (int i = 0; i < 60 && !search.found(); ++i) {
    const TPose2D motion(0.2, 0, 0.3);
    at = at + motion;
    search.process(motion, roomScan(at, random));
  }
  return at;
}

TEST(PlanSearch, FindsTheRobotAndTheScale) {
  PlanSearch search(configuration(), drawn(test::room(), 1.02), {});
  const TPose2D at = circle(search);
  ASSERT_TRUE(search.found());
  EXPECT_NEAR(search.found()->scale, 1.02, 0.005);
  expectNear(*search.found(), TPose2D(3, -2, 0.7) + at);
  EXPECT_FALSE(search.found()->map.lines.lines().empty());
}

TEST(PlanSearch, IsTheSameForAnyNumberOfThreads) {
  const tbb::global_control manyThreads(tbb::global_control::max_allowed_parallelism, 4);
  std::vector<TPose2D> found;
  for (const int threads : {1, 4}) {
    FilterConfiguration c = configuration();
    c.filter.threads = threads;
    PlanSearch search(c, drawn(test::room(), 1.02), {});
    circle(search);
    ASSERT_TRUE(search.found());
    found.push_back(search.found()->pose);
  }
  EXPECT_EQ(found[0], found[1]);
}

// For 10 s at 50 Hz, for instance.
TEST(PlanSearch, FindsARobotThatStandsAtFirst) {
  PlanSearch search(configuration(), drawn(test::room(), 1), {});
  RandomStream random(2, 0, 0);
  const Scans standing = roomScan({3, 0.5, 0.4}, random);
  for (int i = 0; i < 500; ++i) search.process({}, standing);
  EXPECT_FALSE(search.isOver());
  const TPose2D at = circle(search);
  ASSERT_TRUE(search.found());
  expectNear(*search.found(), TPose2D(3, -2, 0.7) + at);
}

TEST(PlanSearch, EndsAfter240ScansThatAreApart) {
  PlanSearch search(configuration(), {{{0, 0}, {1.5, 0}}, {{1.5, 0}, {1.5, 1}}}, {});
  RandomStream random(1, 0, 0);
  const TPose2D turn(0, 0, 24 * kDegree);
  TPose2D at(1, 1, 0);
  for (int i = 0; i < 240; ++i, at = at + turn) {
    EXPECT_FALSE(search.isOver()) << i;
    search.process(turn, roomScan(at, random));
  }
  EXPECT_TRUE(search.isOver());
  EXPECT_FALSE(search.found());
}

TEST(PlanSearch, FitsTheFirstScanAtAGivenStart) {
  RandomStream random(1, 0, 0);
  const TPose2D at(3, 0.5, 0.4), truth = TPose2D(3, -2, 0.7) + at;
  PlanSearch search(configuration(), drawn(test::room(), 1.01),
                    TPose2D(truth.x + 0.3, truth.y - 0.3, truth.phi + 0.2));
  search.process({}, roomScan(at, random));
  ASSERT_TRUE(search.found());
  EXPECT_NEAR(search.found()->scale, 1.01, 0.01);
  expectNear(*search.found(), truth);
}

TEST(PlanSearch, PruningKeepsTheLinesOfThePlan) {
  FilterConfiguration c = configuration();
  c.database.minCount = 5;
  RandomStream random(1, 0, 0);
  const TPose2D at(3, 0.5, 0.4);
  PlanSearch search(c, drawn(test::room(), 1), TPose2D(3, -2, 0.7) + at);
  search.process({}, roomScan(at, random));
  ASSERT_TRUE(search.found());
  for (const DatabaseLine& line : search.found()->map.lines.lines()) EXPECT_EQ(line.count, 5);
}

TEST(PlanSearch, AWrongStartIsNotAccepted) {
  for (const TPose2D& start : {TPose2D(100, 100, 0), TPose2D(3, -2, 0.7) + TPose2D(3, 0.5, 1.4)}) {
    RandomStream random(1, 0, 0);
    PlanSearch search(configuration(), drawn(test::room(), 1), start);
    TPose2D at(3, 0.5, 0.4);
    for (int i = 0; i < 3; ++i, at = at + TPose2D(0, 0, 0.4))
      search.process(i == 0 ? TPose2D() : TPose2D(0, 0, 0.4), roomScan(at, random));
    EXPECT_FALSE(search.found()) << start.asString();
  }
}

// A drawing in a country's coordinates.
TEST(PlanSearch, APlanFarFromItsOriginIsRejected) {
  std::vector<PlanLine> plan = drawn(test::room(), 1, {350000, 450000, 0});
  EXPECT_THROW(PlanSearch(configuration(), plan, {}), InputError);
  EXPECT_THROW(PlanSearch(configuration(), plan, TPose2D(350000, 450000, 0)), InputError);
}

// As of a laser that warms up while the robot drives.
TEST(PlanSearch, MovesTheStartAlongUntilAScanHasReturns) {
  RandomStream random(1, 0, 0);
  TPose2D at(1, 0.5, 0.4);
  PlanSearch search(configuration(), drawn(test::room(), 1), TPose2D(3, -2, 0.7) + at);
  const TPose2D motion(0.2, 0, 0.02);
  for (int i = 0; i < 12; ++i) {
    if (i > 0) at = at + motion;
    const Scans empty = roomScan(at, random);
    for (size_t beam = 0; beam < empty[0]->getScanSize(); ++beam) empty[0]->setScanRangeValidity(beam, false);
    search.process(i == 0 ? TPose2D() : motion, empty);
    EXPECT_FALSE(search.found());
  }
  while (!search.isOver()) {
    at = at + motion;
    search.process(motion, roomScan(at, random));
  }
  ASSERT_TRUE(search.found());
  expectNear(*search.found(), TPose2D(3, -2, 0.7) + at);
}

/// Drives until the robot is found. @return its true pose then, frame of the walls
TPose2D drive(PlanSearch& search, const std::vector<test::DrivenPose>& steps) {
  for (const test::DrivenPose& step : steps) {
    search.process(step.motion, test::observed(step.scans[0]));
    if (search.found()) return step.truth;
  }
  return {};
}

// Every fourth wall is missing, and every fifth is 0.4 m aside.
TEST(PlanSearch, FindsTheRobotInAPartlyWrongPlan) {
  test::Walls halls =
      test::polygon({{0, 0}, {20, 0}, {20, 6}, {14, 6}, {14, 12}, {9, 12}, {9, 6}, {4, 6}, {4, 15}, {0, 15}});
  test::append(halls, test::box(6, 2, 8, 3));
  test::append(halls, test::box(16, 2.5, 17, 4));
  std::vector<PlanLine> plan;
  const std::vector<PlanLine> right = drawn(halls, 1);
  for (size_t i = 0; i < right.size(); ++i) {
    const auto& [start, end] = right[i];
    const mrpt::math::TPoint2D d = end - start, aside = mrpt::math::TPoint2D(-d.y, d.x) * (0.4 / d.norm());
    if (i % 4 == 2) continue;
    plan.push_back(i % 5 == 4 ? PlanLine{start + aside, end + aside} : right[i]);
  }
  PlanSearch search(configuration(), plan, {});
  const TPose2D at = drive(
      search,
      test::driveAlong(halls, {{2, 1}, {18, 1}, {18, 5}, {12, 5}, {12, 11}, {12, 5}, {2, 5}, {2, 13}}, 0));
  ASSERT_TRUE(search.found());
  expectNear(*search.found(), TPose2D(3, -2, 0.7) + at);
}

// The mirrored ring differs from the ring only in its cupboards, so the robot would fit equally well at two
// places.
TEST(PlanSearch, RefusesThePlanOfAnotherBuilding) {
  test::Walls mirrored = test::ring();
  for (auto& wall : mirrored) wall.first.x *= -1, wall.second.x *= -1;
  std::vector<test::DrivenPose> steps = test::ringDrive(0);
  steps.resize(150);
  for (const test::Walls& other : {mirrored, test::room()}) {
    PlanSearch search(configuration(), drawn(other, 1), {});
    drive(search, steps);
    EXPECT_FALSE(search.found());
  }
}

}  // namespace
}  // namespace hybrid_slam
