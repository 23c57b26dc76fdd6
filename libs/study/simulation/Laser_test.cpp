#include "study/simulation/Laser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>
#include <vector>

#include "base/Errors.h"
#include "base/LaserScan.h"
#include "base/RandomStream.h"
#include "study/simulation/BuildingPlan.h"
#include "testing/Restricted.h"

namespace hybrid_slam::simulation {
namespace {

using testing::HasSubstr;

std::vector<Wall> room() {
  return {Wall::straight({0, 0}, {8, 0}), Wall::straight({8, 0}, {8, 6}), Wall::straight({8, 6}, {0, 6}),
          Wall::straight({0, 6}, {0, 0})};
}

LaserOptions exactLms100() {
  LaserOptions options;
  options.noise = false;
  return options;
}

TEST(Laser, BeamCountsApertureAndRangeAreTheSensors) {
  RandomStream random(1, 0, 0);
  const BuildingPlan plan(room());
  const auto check = [&](LaserType type, double resolution, size_t beams, double aperture, float maxRange) {
    LaserOptions options;
    options.sensor = type;
    options.resolutionDeg = resolution;
    const auto scan = Laser(options).scan(plan, {4, 3, 0}, random);
    EXPECT_EQ(scan.getScanSize(), beams);
    EXPECT_NEAR(scan.aperture, mrpt::DEG2RAD(aperture), 1e-6);
    EXPECT_EQ(scan.maxRange, maxRange);
  };
  check(LaserType::lms100, 0.5, 541, 270, 20);
  check(LaserType::lms100, 0.25, 1081, 270, 20);
  check(LaserType::lms200, 1, 181, 180, 80);
  check(LaserType::lms200, 0.5, 361, 180, 80);
}

/// By toLaserScan, every beam's end point is on a wall.
TEST(Laser, WithoutNoiseEveryBeamEndsOnAWall) {
  const BuildingPlan plan(room());
  LaserOptions options = exactLms100();
  options.x = 0.2;
  options.y = -0.1;
  options.yaw = 0.4;
  const Laser laser(options);
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 50; ++i) {
    const mrpt::math::TPose2D robot(1 + 6 * random.uniform(), 1 + 4 * random.uniform(), 7 * random.uniform());
    const LaserScan scan = toLaserScan(laser.scan(plan, robot, random), 20);
    const auto sensor = robot + scan.sensorPose;
    for (const Beam& beam : scan.beams) {
      ASSERT_TRUE(beam.valid);
      const double heading = sensor.phi + beam.angle;
      // Half a millimetre of rounding; the float of the aperture adds a little.
      EXPECT_LT(plan.distanceToNearestWall(
                    {sensor.x + beam.range * std::cos(heading), sensor.y + beam.range * std::sin(heading)}),
                0.00051);
    }
  }
}

TEST(Laser, ReadingsAreWholeMillimetresOrCentimetres) {
  const BuildingPlan plan(room());
  for (const auto& [type, step] : {std::pair(LaserType::lms100, 0.001), std::pair(LaserType::lms200, 0.01)}) {
    LaserOptions options;
    options.sensor = type;
    RandomStream random(3, 0, 0);
    const auto scan = Laser(options).scan(plan, {3.3, 2.7, 0.3}, random);
    for (size_t i = 0; i < scan.getScanSize(); ++i) {
      const double steps = scan.getScanRange(i) / step;
      EXPECT_NEAR(steps, std::round(steps), 1e-3);
    }
  }
}

TEST(Laser, NothingInRangeIsInvalidAndHoldsTheMaximum) {
  const BuildingPlan plan({Wall::straight({5, -50}, {5, 50}), Wall::straight({-20.15, -50}, {-20.15, 50})});
  RandomStream random(4, 0, 0);
  const auto scan = Laser(exactLms100()).scan(plan, {0, 0, M_PI}, random);
  EXPECT_FALSE(scan.getScanRangeValidity(270));  // 20 m exactly: the limit itself is not valid
  EXPECT_EQ(scan.getScanRange(270), 20);
  const auto ahead = Laser(exactLms100()).scan(plan, {0, 0, 0}, random);
  EXPECT_TRUE(ahead.getScanRangeValidity(270));
  EXPECT_NEAR(ahead.getScanRange(270), 4.85, 1e-6);
  EXPECT_FALSE(ahead.getScanRangeValidity(270 - 180));  // along the walls
}

TEST(Laser, NoiseHasTheSensorsSigmaAndNoBias) {
  const BuildingPlan plan(room());
  for (const LaserType type : {LaserType::lms100, LaserType::lms200}) {
    LaserOptions options;
    options.sensor = type;
    const Laser laser(options);
    const LaserSpec& spec = laserSpec(type);
    const mrpt::math::TPose2D robot(3, 2, 0.5);
    double sum = 0, squares = 0, n = 0;
    for (uint64_t k = 0; k < 400; ++k) {
      RandomStream random(5, k, 0);
      const auto scan = laser.scan(plan, robot, random);
      const auto sensor = robot + mrpt::math::TPose2D(options.x, 0, 0);
      for (size_t i = 0; i < scan.getScanSize(); ++i) {
        const double angle = mrpt::DEG2RAD(static_cast<double>(i) * 0.5 - spec.apertureDeg / 2);
        const double error =
            scan.getScanRange(i) - *plan.castRay({sensor.x, sensor.y}, sensor.phi + angle, 100);
        sum += error;
        squares += error * error;
        ++n;
      }
    }
    // Rounding adds the variance of a uniform error; bounds are four standard errors.
    const double sigma = std::sqrt(spec.sigma * spec.sigma + spec.readingStep * spec.readingStep / 12);
    EXPECT_NEAR(sum / n, 0, 4 * sigma / std::sqrt(n)) << spec.name;
    EXPECT_NEAR(std::sqrt(squares / n), sigma, 4 * sigma / std::sqrt(2 * n)) << spec.name;
  }
}

TEST(Laser, MixedPixelsLieBetweenTheTwoSidesOfAnEdge) {
  // A pillar's edge straight ahead at 2 m, a wall behind it at 6 m.
  const BuildingPlan plan({Wall::straight({2, 0}, {2, 1}), Wall::straight({6, -9}, {6, 9})});
  LaserOptions options = exactLms100();
  options.x = 0;
  const size_t ahead = 270;
  const auto rangesAhead = [&](bool mixed) {
    options.mixedPixels = mixed;
    std::vector<double> ranges;
    for (uint64_t k = 0; k < 300; ++k) {
      RandomStream random(6, k, 0);
      ranges.push_back(Laser(options).scan(plan, {0, 0, 0}, random).getScanRange(ahead));
    }
    return ranges;
  };
  for (const double range : rangesAhead(false)) EXPECT_TRUE(range == 2 || range == 6);
  int between = 0;
  for (const double range : rangesAhead(true)) {
    EXPECT_GE(range, 1.999);
    EXPECT_LE(range, 6.001);
    between += range > 2.1 && range < 5.9;
  }
  EXPECT_GT(between, 250);  // 285 expected of a uniform mix
  // Away from the edge nothing changes.
  RandomStream a(7, 0, 0), b(7, 0, 0);
  options.mixedPixels = true;
  const auto mixed = Laser(options).scan(plan, {0, 0, 0}, a);
  options.mixedPixels = false;
  const auto plain = Laser(options).scan(plan, {0, 0, 0}, b);
  for (size_t i = ahead + 3; i < ahead + 45; ++i) EXPECT_EQ(mixed.getScanRange(i), plain.getScanRange(i));
}

std::string errorOf(const LaserOptions& options) {
  try {
    const Laser laser(options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they reserve address space
TEST(Laser, WithoutMemoryThereIsNoScan) {
  const BuildingPlan plan(room());
  const Laser laser(exactLms100());
  RandomStream random(1, 0, 0);
  EXPECT_TRUE(test::throwsWithoutMemory([&] { laser.scan(plan, {4, 3, 0}, random); }));
}
#endif

TEST(Laser, UnsupportedModesAreErrors) {
  LaserOptions options;
  options.resolutionDeg = 1;
  EXPECT_THAT(errorOf(options), HasSubstr("the LMS-100 does not have this resolution: section [laser], key "
                                          "`resolution_deg`; expected 0.5 or 0.25 deg"));
  options.resolutionDeg = 0.25;
  options.rate = 50;
  EXPECT_THAT(errorOf(options), HasSubstr("expected at most 25 Hz at 0.25 deg"));
  options.rate = 25;
  EXPECT_EQ(errorOf(options), "no error");
  options.sensor = LaserType::lms200;
  EXPECT_THAT(errorOf(options), HasSubstr("expected 1 or 0.5 deg"));
}

}  // namespace
}  // namespace hybrid_slam::simulation
