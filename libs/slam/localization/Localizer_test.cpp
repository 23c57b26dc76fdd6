#include "slam/localization/Localizer.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <tbb/global_control.h>

#include "base/Errors.h"
#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;
using Proposal = ParticleFilterOptions::Proposal;

/// A map made of scans from all over an area of 8 m x 5 m.
RoomMap mapOf(const Walls& walls) { return mappedFrom({-2, -1.5}, {6, 3.5}, walls, 80); }

/// A room with rotational symmetry.
const Walls kSymmetric = polygon({{-3, -2.5}, {8, -2.5}, {8, 6}, {-3, 6}});

double offBy(const TPose2D& a, const TPose2D& b) { return std::hypot(a.x - b.x, a.y - b.y); }

double spreadOf(const Localizer& localizer) {
  return std::hypot(localizer.lastStep().stdX, localizer.lastStep().stdY);
}

/// A robot that drives circles of 0.6 m radius from `at` on, with odometry that is 3 % too long.
class Drive {
 public:
  Drive(const Walls& walls, const TPose2D& at, uint64_t seed = 2)
      : walls_(walls), at_(at), random_(seed, 0, 0) {}
  void step(Localizer& localizer, const TPose2D& motion = {0.2, 0, 0.3}) {
    at_ = at_ + motion;
    Scans scans{std::make_shared<mrpt::obs::CObservation2DRangeScan>(observationOf(walls_, at_, random_))};
    localizer.process({1.03 * motion.x + 0.01 * random_.gaussian(), 0.01 * random_.gaussian(), motion.phi},
                      scans);
  }
  /// Puts the robot elsewhere, unnoticed by the odometry.
  void carry(const Walls& walls, const TPose2D& to) { walls_ = walls, at_ = to; }
  const TPose2D& at() const { return at_; }

 private:
  Walls walls_;
  TPose2D at_;
  RandomStream random_;
};

TEST(Localizer, TracksFromAGivenStart) {
  const RoomMap map = mapOf(room());
  for (const auto proposal : {Proposal::improved, Proposal::standard})
    for (const bool hasLines : {true, false}) {
      FilterConfiguration c = with(proposal);
      c.filter.updateDistance = 0.1;
      Drive drive(room(), {4, -0.5, 0.4});
      Localizer localizer(c, map.grid, hasLines ? map.lines : LineDatabase(), TPose2D(4.2, -0.4, 0.45));
      const auto before = localizer.bestGrid();
      for (int i = 0; i < 60; ++i) {
        drive.step(localizer);
        EXPECT_TRUE(localizer.isLocalized());
        EXPECT_LT(offBy(localizer.bestPath().back(), drive.at()), 0.1) << i;
        EXPECT_LT(spreadOf(localizer), 0.1);
      }
      EXPECT_EQ(localizer.updates(), localizer.bestPath().size());
      EXPECT_EQ(localizer.bestGrid().getRawMap(), before.getRawMap());
      EXPECT_EQ(localizer.bestLines().size(), hasLines ? map.lines.lines().size() : 0);
    }
}

// As of a laser that warms up while the robot drives.
TEST(Localizer, MovesTheStartAlongUntilAScanHasReturns) {
  const RoomMap map = mapOf(room());
  TPose2D at(1, 0, 0.4);
  Localizer localizer(FilterConfiguration(), map.grid, map.lines, at);
  const TPose2D motion(0.2, 0, 0.02);
  RandomStream random(3, 0, 0);
  for (int i = 0; i < 12; ++i) {
    if (i > 0) at = at + motion;
    const auto empty =
        std::make_shared<mrpt::obs::CObservation2DRangeScan>(observationOf(room(), at, random));
    for (size_t beam = 0; beam < empty->getScanSize(); ++beam) empty->setScanRangeValidity(beam, false);
    localizer.process(i == 0 ? TPose2D() : motion, {empty});
    EXPECT_FALSE(localizer.isLocalized());
    EXPECT_LT(offBy(localizer.bestPath().back(), at), 0.01);
  }
  Drive drive(room(), at);
  for (int i = 0; i < 10; ++i) drive.step(localizer, motion);
  EXPECT_TRUE(localizer.isLocalized());
  EXPECT_EQ(localizer.losses(), 0u);
  EXPECT_LT(offBy(localizer.bestPath().back(), drive.at()), 0.1);
}

TEST(Localizer, FindsTheRobotInAnAsymmetricRoom) {
  const RoomMap map = mapOf(room());
  for (const bool hasLines : {true, false})
    for (uint64_t seed = 1; seed <= 5; ++seed) {
      RandomStream random(seed, 0, 0);
      Drive drive(room(), {uniform(random, -1, 5), uniform(random, -1, 3), uniform(random, -M_PI, M_PI)},
                  seed);
      Localizer localizer(FilterConfiguration(), map.grid, hasLines ? map.lines : LineDatabase(),
                          std::nullopt);
      int steps = 0;
      while (!localizer.isLocalized() && ++steps < 60) {
        drive.step(localizer);
        if (!localizer.isLocalized()) {
          EXPECT_GT(spreadOf(localizer), 1);
        }
      }
      ASSERT_TRUE(localizer.isLocalized()) << seed << drive.at();
      for (int i = 0; i < 20; ++i) drive.step(localizer);
      EXPECT_LT(offBy(localizer.bestPath().back(), drive.at()), 0.1) << seed;
    }
}

TEST(Localizer, StaysUndecidedWhereTwoPlacesLookAlike) {
  for (const Walls& walls : {kSymmetric, kCorridor}) {
    const RoomMap map = mapOf(walls);
    Drive drive(walls, {2, 0, 0.3});
    Localizer localizer(FilterConfiguration(), map.grid, map.lines, std::nullopt);
    for (int i = 0; i < 60; ++i) {
      drive.step(localizer);
      EXPECT_FALSE(localizer.isLocalized());
      EXPECT_GT(spreadOf(localizer), 1);
    }
  }
}

TEST(Localizer, FindsACarriedRobot) {
  const RoomMap map = mapOf(room());
  for (const auto proposal : {Proposal::improved, Proposal::standard})
    for (const TPose2D& to : {TPose2D(5, 2, 2), TPose2D(-1.5, 3, -1), TPose2D(6, -1, 3)}) {
      Drive drive(room(), {1, 1, 0});
      Localizer localizer(with(proposal), map.grid, map.lines, TPose2D(1, 1, 0));
      for (int i = 0; i < 10; ++i) drive.step(localizer);
      drive.carry(room(), to);
      for (int i = 0; i < 60; ++i) drive.step(localizer);
      EXPECT_TRUE(localizer.isLocalized()) << to;
      EXPECT_LT(offBy(localizer.bestPath().back(), drive.at()), 0.1) << to;
    }
}

/// The room is symmetric except for a nook, and the robot is carried to the place opposite to its own.
TEST(Localizer, CountsAWrongPlaceThatIsReplacedAtOnce) {
  const Walls walls = polygon({{-3, -2.5}, {8, -2.5}, {8, 4}, {7, 4}, {7, 6}, {-3, 6}});
  const RoomMap map = mapOf(walls);
  Drive drive(walls, {0, 0, 0});
  Localizer localizer(FilterConfiguration(), map.grid, map.lines, TPose2D(0, 0, 0));
  for (int i = 0; i < 10; ++i) drive.step(localizer);
  EXPECT_EQ(localizer.losses(), 0u);
  const TPose2D opposite(5 - drive.at().x, 3.5 - drive.at().y, drive.at().phi + M_PI);
  drive.carry(walls, opposite);
  bool wasUnknown = false;
  for (int i = 0; i < 60; ++i) {
    drive.step(localizer);
    wasUnknown = wasUnknown || !localizer.isLocalized();
  }
  EXPECT_LT(offBy(localizer.bestPath().back(), drive.at()), 0.1);
  EXPECT_FALSE(wasUnknown) << "else this test is that of any carried robot";
  EXPECT_EQ(localizer.losses(), 1u);
}

TEST(Localizer, ClaimsNoPlaceOutsideTheMap) {
  const RoomMap map = mapOf(room());
  const Walls elsewhere = polygon({{-1, -1}, {1, -2}, {4, 0}, {2, 5}, {-2, 2}});
  Drive unknown(elsewhere, {1, 1, 0}), taken(room(), {1, 1, 0});
  Localizer started(FilterConfiguration(), map.grid, map.lines, std::nullopt);
  Localizer tracked(FilterConfiguration(), map.grid, map.lines, TPose2D(1, 1, 0));
  for (int i = 0; i < 10; ++i) taken.step(tracked);
  taken.carry(elsewhere, {1, 1, 0});
  for (int i = 0; i < 60; ++i) {
    unknown.step(started);
    EXPECT_FALSE(started.isLocalized());
    EXPECT_GT(spreadOf(started), 1);
    taken.step(tracked);
  }
  EXPECT_FALSE(tracked.isLocalized());
  EXPECT_GT(spreadOf(tracked), 1);
}

TEST(Localizer, FindsARobotThatComesBack) {
  const RoomMap map = mapOf(room());
  Drive drive(room(), {1, 1, 0});
  Localizer localizer(FilterConfiguration(), map.grid, map.lines, TPose2D(1, 1, 0));
  for (int i = 0; i < 10; ++i) drive.step(localizer);
  drive.carry(polygon({{-1, -1}, {1, -2}, {4, 0}, {2, 5}, {-2, 2}}), {1, 1, 0});
  for (int i = 0; i < 80; ++i) drive.step(localizer);
  EXPECT_FALSE(localizer.isLocalized());
  drive.carry(room(), {4, 1, 1});
  for (int i = 0; i < 30; ++i) drive.step(localizer);
  EXPECT_TRUE(localizer.isLocalized());
  EXPECT_LT(offBy(localizer.bestPath().back(), drive.at()), 0.1);
}

TEST(Localizer, IsTheSameForAnyNumberOfThreads) {
  const tbb::global_control manyThreads(tbb::global_control::max_allowed_parallelism, 4);
  const RoomMap map = mapOf(room());
  std::vector<std::vector<TPose2D>> paths;
  for (const int threads : {1, 4}) {
    FilterConfiguration c;
    c.filter.threads = threads;
    Drive drive(room(), {1, 1, 0});
    Localizer localizer(c, map.grid, map.lines, std::nullopt);
    for (int i = 0; i < 50; ++i) drive.step(localizer);
    drive.carry(room(), {5, 2, 2});
    for (int i = 0; i < 50; ++i) drive.step(localizer);
    paths.push_back(localizer.bestPath());
  }
  EXPECT_EQ(paths[0], paths[1]);
}

TEST(Localizer, MrptsAuxiliaryFiltersAreAnError) {
  EXPECT_THROW(Localizer(with(Proposal::auxiliaryOptimal), OccupancyGrid(), {}, std::nullopt), InputError);
}

TEST(Localizer, HasNoPlaceInAnEmptyMap) {
  Drive drive(room(), {1, 1, 0});
  Localizer localizer(FilterConfiguration(), OccupancyGrid(), {}, std::nullopt);
  for (int i = 0; i < 5; ++i) drive.step(localizer);
  EXPECT_FALSE(localizer.isLocalized());
}

}  // namespace
}  // namespace hybrid_slam
