#include "slam/filter/MountingEstimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/Degree.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

using OdometryError = std::function<TPose2D(const TPose2D&)>;
TPose2D asDriven(const TPose2D& motion) { return motion; }

/// The estimate of a laser with this mounting on a robot that drives through corridors.
std::optional<Mounting> estimated(double yaw, bool isUpsideDown, const OdometryError& error = asDriven) {
  MountingEstimate estimate{GridOptions(), ScanMatcherOptions()};
  RandomStream random(1, 0, 0);
  const auto walls = test::ring();
  double time = 0;
  for (const test::DrivenPose& at : test::driveAlong(walls, {{0, 0}, {31.5, 0}, {31.5, 21}, {0, 21}}, 0)) {
    const LaserScan seen = test::scanOf(walls, at.truth, {0, 0, yaw}, 181, M_PI, 0.01, random);
    const Scans scans = test::observed(seen);
    scans[0]->sensorPose = {};
    for (size_t i = 0; isUpsideDown && i < seen.beams.size(); ++i) {
      const Beam& beam = seen.beams[seen.beams.size() - 1 - i];
      scans[0]->setScanRange(i, static_cast<float>(beam.range));
      scans[0]->setScanRangeValidity(i, beam.valid);
    }
    estimate.add(error(at.motion), scans, time += 0.5);
    if (estimate.isDone()) break;
  }
  return estimate.mounting();
}

TEST(MountingEstimate, TheYawIsBetweenTheMotionsOfScansAndOdometry) {
  for (const double yaw : {0., 30., -90., 180.}) {
    const auto mounting = estimated(yaw * kDegree, false);
    ASSERT_TRUE(mounting) << yaw;
    EXPECT_NEAR(std::remainder(mounting->yaw - yaw * kDegree, 2 * M_PI), 0, 1.5 * kDegree) << yaw;
    EXPECT_FALSE(mounting->isUpsideDown) << yaw;
  }
}

TEST(MountingEstimate, ALaserUpsideDownTurnsTheOtherWay) {
  for (const double yaw : {0., 90.}) {
    const auto mounting = estimated(yaw * kDegree, true);
    ASSERT_TRUE(mounting) << yaw;
    EXPECT_NEAR(std::remainder(mounting->yaw - yaw * kDegree, 2 * M_PI), 0, 1.5 * kDegree) << yaw;
    EXPECT_TRUE(mounting->isUpsideDown) << yaw;
  }
}

TEST(MountingEstimate, OdometryThatTheScansDoNotFollowGivesNone) {
  RandomStream random(2, 0, 0);
  EXPECT_FALSE(estimated(0, false, [&](const TPose2D& motion) {
    const double direction = 2 * M_PI * random.uniform();
    return TPose2D(motion.x * std::cos(direction), motion.x * std::sin(direction), motion.phi);
  })) << "of no direction";
  EXPECT_FALSE(estimated(0, false, [&](const TPose2D& motion) {
    return TPose2D(motion.x, motion.y, random.uniform() < 0.5 ? motion.phi : -motion.phi);
  })) << "turns in both directions";
  EXPECT_FALSE(estimated(0, false, [&](const TPose2D& motion) {
    return TPose2D(3 * motion.x, 0, motion.phi);
  })) << "of another length";
}

TEST(MountingEstimate, WithoutTurnsALaserMayBeUpsideDown) {
  EXPECT_FALSE(
      estimated(90 * kDegree, false, [](const TPose2D& motion) { return TPose2D(motion.x, motion.y, 0); }));
}

}  // namespace
}  // namespace hybrid_slam
