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
std::optional<double> estimated(double yaw, bool isUpsideDown, const OdometryError& error = asDriven) {
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
  return estimate.yaw();
}

TEST(MountingEstimate, TheYawIsBetweenTheMotionsOfScansAndOdometry) {
  for (const double yaw : {0., 30., -90., 180.}) {
    const auto found = estimated(yaw * kDegree, false);
    ASSERT_TRUE(found) << yaw;
    EXPECT_NEAR(std::remainder(*found - yaw * kDegree, 2 * M_PI), 0, 1.5 * kDegree) << yaw;
  }
}

TEST(MountingEstimate, AMirrorImageHasAYawToo) {
  const auto mirrored = [](const TPose2D& motion) { return TPose2D(motion.x, -motion.y, -motion.phi); };
  for (const bool isUpsideDown : {false, true}) {
    const auto found = estimated(90 * kDegree, isUpsideDown, mirrored);
    ASSERT_TRUE(found) << isUpsideDown;
    EXPECT_NEAR(*found, (isUpsideDown ? -90 : 90) * kDegree, 1.5 * kDegree) << isUpsideDown;
  }
}

TEST(MountingEstimate, OdometryThatTheScansDoNotFollowGivesNone) {
  RandomStream random(2, 0, 0);
  EXPECT_FALSE(estimated(0, false, [&](const TPose2D& motion) {
    const double direction = 2 * M_PI * random.uniform();
    return TPose2D(motion.x * std::cos(direction), motion.x * std::sin(direction), motion.phi);
  })) << "of no direction";
  EXPECT_FALSE(estimated(0, false, [&](const TPose2D& motion) {
    return TPose2D(3 * motion.x, 0, motion.phi);
  })) << "of another length";
}

}  // namespace
}  // namespace hybrid_slam
