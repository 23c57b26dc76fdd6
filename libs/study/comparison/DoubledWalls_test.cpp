#include "study/comparison/DoubledWalls.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/RandomStream.h"

namespace hybrid_slam::comparison {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Scans of a 360 deg laser in a plan from the true poses, and the poses of a run.
struct Drive {
  simulation::BuildingPlan plan;
  size_t beams = 360;
  double maxRange = 20;
  double noise = 0.02;  // m
  files::Trajectory truth{}, run{};
  std::vector<readings::EndPoints> scans{};

  void add(double time, const TPose2D& at, const TPose2D& claimed) {
    truth.push_back({time, at});
    run.push_back({time, claimed});
    RandomStream random(1, scans.size(), 0);
    readings::EndPoints scan{time, {}};
    for (size_t i = 0; i < beams; ++i) {
      const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(beams);
      if (auto range = plan.castRay({at.x, at.y}, at.phi + angle, maxRange)) {
        *range += noise * random.gaussian();
        scan.points.emplace_back(*range * std::cos(angle), *range * std::sin(angle));
      }
    }
    scans.push_back(scan);
  }
  WallSightings sightings() const { return {plan, truth, scans, 0.02}; }
  double share() const { return sightings().doubledShare(run).value(); }
};

simulation::BuildingPlan room(double length, double width) {
  return simulation::BuildingPlan({simulation::Wall::straight({0, 0}, {length, 0}),
                                   simulation::Wall::straight({length, 0}, {length, width}),
                                   simulation::Wall::straight({length, width}, {0, width}),
                                   simulation::Wall::straight({0, width}, {0, 0})});
}

/// Drives along a corridor of 20 m x 3 m, and again `pause` s later with poses that are `shift` off.
Drive twiceAlongACorridor(const TPoint2D& shift, double pause = 100) {
  Drive drive{room(20, 3)};
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 0; i <= 64; ++i) {
      const TPose2D at(2 + 0.25 * i, 1.5, 0.1 * std::sin(i));
      drive.add(pass * (32 + pause) + 0.5 * i, at,
                pass == 0 ? at : TPose2D(at.x + shift.x, at.y + shift.y, at.phi));
    }
  return drive;
}

TEST(DoubledWalls, TrueAndRigidlyMovedPosesDoubleNothing) {
  Drive drive = twiceAlongACorridor({0, 0});
  EXPECT_EQ(drive.share(), 0);
  for (files::StampedPose& p : drive.run) p.pose = TPose2D(5, -7, 2.5) + p.pose;
  EXPECT_EQ(drive.share(), 0);
}

TEST(DoubledWalls, OnlyWhatMovesAcrossAWallDoublesIt) {
  for (const double shift : {0.3, 1.0, 2.0, 5.0, 30.0}) {
    EXPECT_NEAR(twiceAlongACorridor({0, shift}).share(), 40.0 / 46, 0.01) << shift;
    EXPECT_NEAR(twiceAlongACorridor({-shift, 0}).share(), 6.0 / 46, 0.01) << shift;
  }
  EXPECT_EQ(twiceAlongACorridor({0.15, 0.15}).share(), 0);
}

TEST(DoubledWalls, WallsCanBeDoubledWithinAPass) {
  EXPECT_NEAR(twiceAlongACorridor({0, 0.3}, 5).share(), 40.0 / 46, 0.01);
  Drive drive = twiceAlongACorridor({0, 0});
  for (size_t i = 0; i < drive.run.size(); i += 2) drive.run[i].pose.y += 0.3;
  EXPECT_NEAR(drive.share(), 40.0 / 46, 0.01);
}

TEST(DoubledWalls, AFewStrayPosesDoubleNothing) {
  Drive drive = twiceAlongACorridor({0, 0});
  for (const size_t i : {20, 40, 90}) drive.run[i].pose.y += 1;
  EXPECT_EQ(drive.share(), 0);
}

TEST(DoubledWalls, ABentMapIsNotDoubled) {
  Drive drive{room(20, 3)};
  drive.maxRange = 8;
  for (int i = 0; i <= 64; ++i) {
    const TPose2D at(2 + 0.25 * i, 1.5, 0);
    drive.add(0.5 * i, at, {at.x, at.y + 0.002 * at.x * at.x, 0.004 * at.x});  // 0.8 m at the far end
  }
  EXPECT_EQ(drive.share(), 0);
}

/// A robot that turns in the middle of a room of 12 m x 8 m, twice.
Drive turning(double (*headingError)(int pass, double progress)) {
  Drive drive{room(12, 8)};
  drive.beams = 1440;
  drive.noise = 0;
  constexpr int kSteps = 144;
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 0; i <= kSteps; ++i) {
      const double progress = static_cast<double>(i) / kSteps, phi = 16 * M_PI * progress;
      drive.add(pass * 100 + 0.3 * i, {6, 4, phi}, {6, 4, phi + headingError(pass, progress)});
    }
  return drive;
}

// A rotation by a about the centre of the room moves a wall's point at s from the wall's middle by s a across
// it.
TEST(DoubledWalls, HeadingErrorsByHand) {
  // 0.05 rad between the passes: 0.2 m at 4 m, so that the outer 2 m of the long walls are doubled.
  const Drive turned = turning([](int pass, double) { return 0.05 * pass; });
  EXPECT_NEAR(turned.share(), 4 * 2.0 / 40, 0.006);
  // A drift to 0.06 rad that closes: within a pass, 80 % of it lie between the percentiles, 0.2 m at 4.17 m.
  const Drive closing = turning([](int, double progress) { return 0.06 * (1 - std::abs(2 * progress - 1)); });
  EXPECT_NEAR(closing.share(), 4 * (6 - 0.2 / 0.048) / 40, 0.006);
  // A drift to 0.04 rad displaces even the corners by only 0.19 m.
  EXPECT_EQ(turning([](int, double progress) { return 0.04 * (1 - std::abs(2 * progress - 1)); }).share(), 0);
}

TEST(DoubledWalls, NoShownWallGivesNoShare) {
  const Drive drive = twiceAlongACorridor({0, 0});
  EXPECT_FALSE(drive.sightings().empty());
  files::Trajectory late = drive.run;
  for (files::StampedPose& p : late) p.timestamp += 1e4;
  EXPECT_FALSE(drive.sightings().doubledShare(late));
  const simulation::BuildingPlan elsewhere({simulation::Wall::straight({100, 0}, {120, 0})});
  EXPECT_TRUE(WallSightings(elsewhere, drive.truth, drive.scans, 0.02).empty());
  EXPECT_TRUE(WallSightings(drive.plan, late, drive.scans, 0.02).empty());
}

// The loop of the experiments: its last 14 m revisit the south corridor, where it began.
TEST(DoubledWalls, TheCsieLoopsReturnIsFound) {
  Drive drive{simulation::BuildingPlan::load(SOURCE_DIR "/datasets/csie/csie.plan")};
  const files::Trajectory truth = files::loadTum(SOURCE_DIR "/datasets/csie/csie-loop.tum");
  for (size_t i = 0; i < truth.size(); i += 2) drive.add(truth[i].timestamp, truth[i].pose, truth[i].pose);
  const WallSightings sightings = drive.sightings();
  EXPECT_EQ(sightings.doubledShare(truth), 0);
  for (const double shift : {0.3, 0.8, 2.0, 3.0, -2.0}) {
    files::Trajectory run = truth;
    for (size_t i = truth.size() / 2; i < truth.size(); ++i)
      if (truth[i].pose.y < 2.5) run[i].pose.y += shift;
    const double share = sightings.doubledShare(run).value();
    EXPECT_GT(share, 0.05) << shift;
    EXPECT_LT(share, 0.25) << shift;
  }
}

}  // namespace
}  // namespace hybrid_slam::comparison
