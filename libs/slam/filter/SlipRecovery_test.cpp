#include "slam/filter/SlipRecovery.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/PoseOffset.h"
#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

const TPose2D kSlipStart(0.4, 0.3, 0.5), kSlipOdometry(0.25, 0.01, 0.05);

SlipRecovery slipRecovery(const ImprovedProposalOptions& options = {}) {
  FilterConfiguration c;
  c.improved = options;
  return SlipRecovery(c);
}

/// A SlipRecovery that has processed a few scans without a slip, so that it knows the usual fit.
/// @param off  m: how far from the odometry, which is right, a match may end
SlipRecovery used(Particle& particle, const test::Walls& walls, double off = 0.02) {
  SlipRecovery recovery = slipRecovery();
  const TPose2D end = particle.path.back();
  RandomStream random(3, 0, 0);
  for (int i = 0; i < 5; ++i) {
    const StepMotion motion =
        recovery.motionsOf(particle, kSlipOdometry, test::prepared(walls, end + kSlipOdometry, random))
            .front();
    EXPECT_FALSE(motion.hasSlipped);
    EXPECT_LT(offsetOf(motion.start, kSlipOdometry).head<2>().norm(), off);
    EXPECT_LT(std::abs(offsetOf(motion.start, kSlipOdometry).z()), 0.3 * kDegree);
  }
  return recovery;
}

TEST(SlipRecovery, FindsTheMotionAfterASlip) {
  for (const TPose2D& slip :
       {TPose2D(0, 0, 30 * kDegree), TPose2D(0, 0, -30 * kDegree), TPose2D(0, 0, 80 * kDegree),
        TPose2D(0, 0, 170 * kDegree), TPose2D(0.5, 0, 0), TPose2D(-0.4, 0.3, 20 * kDegree)}) {
    Particle particle = test::particleAt(test::room(), kSlipStart);
    SlipRecovery recovery = used(particle, test::room());
    RandomStream random(4, 0, 0);
    const TPose2D truth = kSlipStart + (kSlipOdometry + slip);
    const StepMotion motion =
        recovery.motionsOf(particle, kSlipOdometry, test::prepared(test::room(), truth, random)).front();
    EXPECT_TRUE(motion.hasSlipped) << slip.asString();
    EXPECT_EQ(motion.odometry, kSlipOdometry);
    EXPECT_LT(offsetOf(kSlipStart + motion.start, truth).head<2>().norm(), 0.03) << slip.asString();
    EXPECT_LT(std::abs(offsetOf(kSlipStart + motion.start, truth).z()), 0.5 * kDegree) << slip.asString();
  }
}

/// In a long step, the error of spinning wheels or of odometry without its sign is beyond the window.
TEST(SlipRecovery, FindsARobotThatStoodStillOrMovedBackward) {
  const TPose2D odometry(1.2, 0.1, 0.2);
  for (const double share : {0, -1}) {
    Particle particle = test::particleAt(test::room(), kSlipStart);
    SlipRecovery recovery = used(particle, test::room());
    RandomStream random(9, 0, 0);
    const TPose2D truth = kSlipStart + TPose2D(share * odometry.x, share * odometry.y, odometry.phi);
    const StepMotion motion =
        recovery.motionsOf(particle, odometry, test::prepared(test::room(), truth, random)).front();
    EXPECT_TRUE(motion.hasSlipped) << share;
    EXPECT_LT(offsetOf(kSlipStart + motion.start, truth).head<2>().norm(), 0.03) << share;
    EXPECT_LT(std::abs(offsetOf(kSlipStart + motion.start, truth).z()), 0.5 * kDegree) << share;
  }
}

/// Four beams, three of them on people in front of the walls, say little about where the robot is.
TEST(SlipRecovery, FewBeamsRarelyOverruleTheOdometry) {
  int slips = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    Particle particle = test::particleAt(test::room(), kSlipStart);
    SlipRecovery recovery = used(particle, test::room());
    RandomStream random(100 + seed, 0, 0);
    PreparedScan scan = test::prepared(test::room(), kSlipStart + kSlipOdometry, random);
    for (ScanBeams* const beams : {&scan.matchedBeams, &scan.weighedBeams}) {
      auto& rays = beams->rays;
      const size_t every = rays.size() / 4;
      for (size_t i = 0; i < 4; ++i) rays[i] = rays[i * every + seed % every];
      rays.resize(4);
      for (size_t i = 0; i < 3; ++i) rays[i].range *= 0.95;
    }
    slips += recovery.motionsOf(particle, kSlipOdometry, scan).front().hasSlipped;
  }
  EXPECT_LE(slips, 4);
}

/// The newest scans show only what a tenth of the beams still sees after the slip, a person who turns with
/// the robot. That is no evidence against the slip.
TEST(SlipRecovery, ASlipIsFoundWhereTheNewestScansKnowLittle) {
  for (const double turn : {30, 80, 170}) {
    Particle particle = test::particleAt(test::room(), kSlipStart);
    SlipRecovery recovery = used(particle, test::room());
    RandomStream random(11, 0, 0);
    PreparedScan before = test::prepared(test::room(), kSlipStart, random);
    auto& person = before.matchedBeams.rays;
    person.resize(person.size() / 10);
    for (int i = 0; i < 5; ++i) {
      recovery.motionsOf(particle, {}, before);
      particle.path.push(kSlipStart);
    }
    const TPose2D truth = kSlipStart + TPose2D(0, 0, turn * kDegree);
    PreparedScan scan = test::prepared(test::room(), truth, random);
    std::copy(person.begin(), person.end(), scan.matchedBeams.rays.begin());
    const StepMotion motion = recovery.motionsOf(particle, {}, scan).front();
    EXPECT_TRUE(motion.hasSlipped) << turn;
    EXPECT_LT(offsetOf(kSlipStart + motion.start, truth).head<2>().norm(), 0.05) << turn;
    EXPECT_LT(std::abs(offsetOf(kSlipStart + motion.start, truth).z()), 1 * kDegree) << turn;
  }
}

struct Found {
  bool isTrue = false;  ///< a hypothesis was the true pose
  size_t most = 0;      ///< number of hypotheses in a step
};

/// Returns the hypotheses for a robot that was carried and turns on the spot. The particle follows the first.
Found carried(const test::Walls& walls, TPose2D robot, bool useLines) {
  const TPose2D turn(0, 0, 0.3);
  Particle particle = test::particleAt(walls, kSlipStart);
  SlipRecovery recovery = used(particle, walls);
  RandomStream random(8, 0, 0);
  Found found;
  for (int i = 0; i < 12; ++i) {
    robot = robot + turn;
    PreparedScan scan = test::prepared(walls, robot, random);
    if (!useLines) scan.lines.clear();
    const auto motions = recovery.motionsOf(particle, turn, scan);
    for (const StepMotion& motion : motions) {
      const auto off = offsetOf(particle.path.back() + motion.start, robot);
      found.isTrue |= off.head<2>().norm() < 0.05 && std::abs(off.z()) < 1 * kDegree;
    }
    found.most = std::max(found.most, motions.size());
    particle.path.push(particle.path.back() + motions[0].start);
  }
  return found;
}

/// The robot is put down elsewhere in the mapped room, with and without lines, which give four headings.
TEST(SlipRecovery, FindsACarriedRobot) {
  for (const bool useLines : {true, false})
    for (const TPose2D& robot : {TPose2D(5, 2, 2), TPose2D(-1.5, 4, -1), TPose2D(6.5, -1, 3)})
      EXPECT_TRUE(carried(test::room(), robot, useLines).isTrue) << robot.asString() << useLines;
}

/// A square room looks the same four ways: the particles keep several.
TEST(SlipRecovery, KeepsHypothesesThatAScanCannotDecide) {
  const Found found = carried(test::polygon({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}), {-2, 1, 2}, true);
  EXPECT_TRUE(found.isTrue);
  EXPECT_GE(found.most, 3u);
}

TEST(SlipRecovery, CanBeSwitchedOff) {
  ImprovedProposalOptions options;
  options.slipDistance = 0;
  Particle particle = test::particleAt(test::room(), kSlipStart);
  SlipRecovery recovery = slipRecovery(options);
  RandomStream random(5, 0, 0);
  const auto motion = recovery
                          .motionsOf(particle, kSlipOdometry,
                                     test::prepared(test::room(), kSlipStart + TPose2D(0, 0, 0.5), random))
                          .front();
  EXPECT_FALSE(motion.hasSlipped);
  EXPECT_EQ(motion.start, kSlipOdometry);
}

TEST(SlipRecovery, AScanOfAnUnknownPlaceIsNotASlip) {
  Particle particle = test::particleAt(test::room(), kSlipStart);
  SlipRecovery recovery = used(particle, test::room());
  RandomStream random(6, 0, 0);
  // The robot is carried through a door: nothing here has been mapped.
  const test::Walls elsewhere = test::polygon({{-30, -20}, {20, -20}, {20, 25}, {-30, 25}});
  const StepMotion motion =
      recovery
          .motionsOf(particle, kSlipOdometry, test::prepared(elsewhere, kSlipStart + kSlipOdometry, random))
          .front();
  EXPECT_FALSE(motion.hasSlipped);
}

/// The map of the corridor ends: the new part must not pull the robot back to the walls it has seen.
TEST(SlipRecovery, ACorridorSeenForTheFirstTimeIsNotASlip) {
  const TPose2D start(0, 0.1, 0);
  Particle particle;
  particle.path.push(start);
  RandomStream random(7, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const TPose2D robot(-0.2 * i, 0.1, 0);
    particle.grid.insert(test::prepared(kCorridor, robot, random).beams, robot, GridOptions());
  }
  // Along the corridor, the rough walls compete with the odometry: allow three of its standard deviations,
  // 1.1 cm each.
  SlipRecovery recovery = used(particle, kCorridor, 0.033);
  const test::Walls open{{{-1000, -1.2}, {1000, -1.2}}, {{-1000, 1.2}, {1.5, 1.2}}};
  for (const TPose2D& odometry : {kSlipOdometry, TPose2D(1.2, 0.01, 0.05), TPose2D(2.5, 0, 0.1)}) {
    SlipRecovery here = recovery;
    EXPECT_FALSE(
        here.motionsOf(particle, odometry, test::prepared(open, start + odometry, random)).front().hasSlipped)
        << odometry.asString();
  }
}

/// Two corridors of 30 m x 2.4 m that cross at (x, y).
test::Walls crossing(double x, double y) {
  constexpr double a = 1.2, b = 15;
  test::Walls walls = test::polygon({{-b, -a},
                                     {-a, -a},
                                     {-a, -b},
                                     {a, -b},
                                     {a, -a},
                                     {b, -a},
                                     {b, a},
                                     {a, a},
                                     {a, b},
                                     {-a, b},
                                     {-a, a},
                                     {-b, a}});
  for (auto& [from, to] : walls) from += TPoint2D(x, y), to += TPoint2D(x, y);
  return walls;
}

/// The robot crosses a corridor that it has mapped before its path drifted by a metre, and another crossing
/// looks the same. It is where the odometry says: the drift is left to loop closing.
TEST(SlipRecovery, AReturnAfterDriftIsNotACarriedRobot) {
  const TPose2D drift(0.9, 0.7, 0);
  Particle particle;
  particle.grid = OccupancyGrid(GridOptions().resolution);
  RandomStream random(10, 0, 0);
  const auto map = [&](const test::Walls& walls, const TPose2D& robot, const TPose2D& as) {
    particle.grid.insert(test::prepared(walls, robot, random).beams, as, GridOptions());
  };
  for (int i = -32; i <= 32; ++i)
    for (const double heading : {0.5 * M_PI, -0.5 * M_PI}) {
      const TPose2D across(0, 0.25 * i, heading), there = TPose2D(60, 40, 0) + across;
      map(crossing(0, 0), across, drift + across);
      map(crossing(60, 40), there, there);
      map(crossing(60, 40), TPose2D(60, 40, 0) + TPose2D(0.25 * i, 0, heading - 0.5 * M_PI),
          TPose2D(60, 40, 0) + TPose2D(0.25 * i, 0, heading - 0.5 * M_PI));
    }
  SlipRecovery recovery = slipRecovery();
  const TPose2D step(0.25, 0, 0);
  TPose2D robot(-9, 0.1, 0);
  particle.path.push(robot);
  map(crossing(0, 0), robot, robot);
  for (; robot.x < 6; robot = robot + step) {
    const PreparedScan scan = test::prepared(crossing(0, 0), robot + step, random);
    const StepMotion motion = recovery.motionsOf(particle, step, scan).front();
    EXPECT_FALSE(motion.hasSlipped) << robot.x;
    particle.path.push(particle.path.back() + motion.start);
    particle.grid.insert(scan.beams, particle.path.back(), GridOptions());
  }
  EXPECT_LT(offsetOf(particle.path.back(), robot).head<2>().norm(), 1.2);
}

/// The robot turns where two corridors cross that its drifted map shows a metre off. Turned by 90 deg, it
/// would fit better, but not well.
TEST(SlipRecovery, ATurnAfterDriftIsNotASlip) {
  const test::Walls walls = crossing(0, 0);
  for (const TPose2D& drift : {TPose2D(0.9, 0.7, 0), TPose2D(-0.8, 0.9, 0), TPose2D(0.5, -1, 0.03)}) {
    for (const double error : {2, 4, 6}) {  // deg, in every second turn of 20 deg
      Particle particle;
      particle.grid = OccupancyGrid(GridOptions().resolution);
      RandomStream random(12, 0, 0);
      const auto map = [&](const TPose2D& robot, const TPose2D& as) {
        particle.grid.insert(test::prepared(walls, robot, random).beams, as, GridOptions());
      };
      for (int i = -32; i <= 32; ++i)
        for (const double heading : {0.5 * M_PI, -0.5 * M_PI})
          map({0, 0.25 * i, heading}, drift + TPose2D(0, 0.25 * i, heading));
      SlipRecovery recovery = slipRecovery();
      TPose2D robot(-9, 0.1, 0);
      particle.path.push(robot);
      const auto move = [&](const TPose2D& odometry, const TPose2D& truth) {
        robot = robot + truth;
        const PreparedScan scan = test::prepared(walls, robot, random);
        const StepMotion motion = recovery.motionsOf(particle, odometry, scan).front();
        particle.path.push(particle.path.back() + motion.start);
        particle.grid.insert(scan.beams, particle.path.back(), GridOptions());
        EXPECT_LT(std::abs(offsetOf(particle.path.back(), robot).z()), 30 * kDegree)
            << drift.asString() << error;
      };
      map(robot, robot);
      while (robot.x < -0.1) move({0.25, 0, 0}, {0.25, 0, 0});
      for (int i = 0; i < 5; ++i) move({0, 0, -20 * kDegree}, {0, 0, (-20 + error * (i % 2)) * kDegree});
    }
  }
}

TEST(MotionAfter, IsTheMotionModelOrAsWideAsTheWindow) {
  FilterConfiguration c;
  for (MotionTerm* term : {&c.motion.distance, &c.motion.drift, &c.motion.turn}) term->meanStd = 0;
  Particle particle;
  particle.path.push(kSlipStart);
  const MotionDistribution model = motionDistribution(kSlipStart, kSlipOdometry, c.motion);
  const MotionDistribution usual =
      motionAfter(particle, {kSlipOdometry, kSlipOdometry, false}, c.motion, c.improved);
  EXPECT_EQ(usual.mean, model.mean);
  EXPECT_LT((usual.covariance - model.covariance).norm(), 1e-7);
  const MotionDistribution slipped =
      motionAfter(particle, {kSlipOdometry, {0.5, 0, 0}, true}, c.motion, c.improved);
  EXPECT_EQ(slipped.mean, kSlipStart + TPose2D(0.5, 0, 0));
  EXPECT_NEAR(slipped.covariance(0, 0) - model.covariance(0, 0), 0.25, 1e-6);
  EXPECT_NEAR(slipped.covariance(2, 2) - model.covariance(2, 2), std::pow(30 * kDegree, 2), 1e-6);
}

}  // namespace
}  // namespace hybrid_slam
