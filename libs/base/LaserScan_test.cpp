#include "base/LaserScan.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>
#include <limits>

#include "base/Degree.h"
#include "base/Errors.h"

namespace hybrid_slam {
namespace {

/// Beams at -90, 0, +90 deg with ranges 1, 2, 3 m.
mrpt::obs::CObservation2DRangeScan threeBeams() {
  mrpt::obs::CObservation2DRangeScan o;
  o.aperture = static_cast<float>(M_PI);
  o.rightToLeft = true;
  o.maxRange = 80;
  o.resizeScan(3);
  for (size_t i = 0; i < 3; ++i) {
    o.setScanRange(i, static_cast<float>(i + 1));
    o.setScanRangeValidity(i, true);
  }
  return o;
}

void expectRanges(const LaserScan& scan, double right, double ahead, double left) {
  ASSERT_EQ(scan.beams.size(), 3u);
  EXPECT_NEAR(scan.beams[0].angle, -M_PI / 2, 1e-6);
  EXPECT_NEAR(scan.beams[1].angle, 0, 1e-6);
  EXPECT_NEAR(scan.beams[2].angle, M_PI / 2, 1e-6);
  EXPECT_EQ(scan.beams[0].range, right);
  EXPECT_EQ(scan.beams[1].range, ahead);
  EXPECT_EQ(scan.beams[2].range, left);
}

TEST(LaserScan, BeamsRunFromRightToLeft) { expectRanges(toLaserScan(threeBeams(), 20), 1, 2, 3); }

TEST(LaserScan, ClockwiseBeamsAreReversed) {
  auto o = threeBeams();
  o.rightToLeft = false;
  expectRanges(toLaserScan(o, 20), 3, 2, 1);
}

TEST(LaserScan, UpsideDownByRollSwapsRightAndLeft) {
  auto o = threeBeams();
  o.sensorPose = mrpt::poses::CPose3D(0.4, 0.1, 0.3, 30 * kDegree, 0, M_PI);
  const LaserScan scan = toLaserScan(o, 20);
  expectRanges(scan, 3, 2, 1);
  EXPECT_NEAR(scan.sensorPose.x, 0.4, 1e-12);
  EXPECT_NEAR(scan.sensorPose.y, 0.1, 1e-12);
  EXPECT_NEAR(scan.sensorPose.phi, 30 * kDegree, 1e-12);
}

TEST(LaserScan, UpsideDownByPitchLooksBackwards) {
  auto o = threeBeams();
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, M_PI, 0);
  const LaserScan scan = toLaserScan(o, 20);
  expectRanges(scan, 3, 2, 1);
  EXPECT_NEAR(std::abs(scan.sensorPose.phi), M_PI, 1e-12);
}

/// For any mounting, a beam's end point must agree with MRPT's full 3D geometry.
TEST(LaserScan, BeamEndsAgreeWithTheSensorsThreeDimensionalPose) {
  for (const double roll : {0.0, M_PI})
    for (const double pitch : {0.0, M_PI})
      for (const double yaw : {-2.0, 0.0, 0.7})
        for (const bool rightToLeft : {true, false}) {
          auto o = threeBeams();
          o.rightToLeft = rightToLeft;
          o.sensorPose = mrpt::poses::CPose3D(0.3, -0.2, 0.5, yaw, pitch, roll);
          const LaserScan scan = toLaserScan(o, 20);
          for (size_t i = 0; i < 3; ++i) {
            const double angle = o.getScanAngle(i), range = o.getScanRange(i);
            double x = 0, y = 0, z = 0;
            o.sensorPose.composePoint(range * std::cos(angle), range * std::sin(angle), 0, x, y, z);
            bool found = false;
            for (const Beam& beam : scan.beams) {
              const double heading = scan.sensorPose.phi + beam.angle;
              found |= std::hypot(scan.sensorPose.x + beam.range * std::cos(heading) - x,
                                  scan.sensorPose.y + beam.range * std::sin(heading) - y) < 1e-6;
            }
            EXPECT_TRUE(found) << "beam " << i << " roll " << roll << " pitch " << pitch << " yaw " << yaw;
          }
        }
}

TEST(LaserScan, UnusableReadingsAreInvalidOneByOne) {
  for (const float bad : {0.0f, -1.0f, 20.0f, 81.83f, std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity()}) {
    auto o = threeBeams();
    o.setScanRange(1, bad);
    const LaserScan scan = toLaserScan(o, 20);
    EXPECT_TRUE(scan.beams[0].valid);
    EXPECT_FALSE(scan.beams[1].valid) << bad;
    EXPECT_TRUE(scan.beams[2].valid);
  }
}

TEST(LaserScan, TheSmallerMaximumRangeApplies) {
  auto o = threeBeams();
  o.maxRange = 2.5f;
  const LaserScan scan = toLaserScan(o, 20);
  EXPECT_TRUE(scan.beams[1].valid);
  EXPECT_FALSE(scan.beams[2].valid);
}

TEST(LaserScan, EmptyAndSingleBeamScans) {
  mrpt::obs::CObservation2DRangeScan o;
  EXPECT_TRUE(toLaserScan(o, 20).beams.empty());
  o.resizeScan(1);
  o.setScanRange(0, 2);
  o.setScanRangeValidity(0, true);
  EXPECT_EQ(toLaserScan(o, 20).beams.at(0).angle, 0);
}

TEST(LaserScan, OfTooManyBeamsEveryNthIsKept) {
  mrpt::obs::CObservation2DRangeScan o;
  o.aperture = 2;
  for (const size_t n : {kMostScanBeams, kMostScanBeams + 1, 2 * kMostScanBeams + 1, size_t{1000000}}) {
    o.resizeScan(n);
    for (size_t i = 0; i < n; ++i)
      o.setScanRange(i, static_cast<float>(1 + i)), o.setScanRangeValidity(i, true);
    for (const bool isRightToLeft : {true, false}) {
      o.rightToLeft = isRightToLeft;
      o.maxRange = 1e7F;
      const LaserScan scan = toLaserScan(o, 1e7);
      EXPECT_LE(scan.beams.size(), kMostScanBeams);
      EXPECT_GT(scan.beams.size(), kMostScanBeams / 2);
      for (const Beam& beam : scan.beams) {
        const double angle = -1 + 2 * (beam.range - 1) / static_cast<double>(n - 1);
        ASSERT_NEAR(beam.angle, isRightToLeft ? angle : -angle, 1e-9);
      }
      EXPECT_LT(scan.beams.front().angle, scan.beams.back().angle);
    }
  }
}

TEST(LaserScan, TiltedPlaneIsAnError) {
  auto o = threeBeams();
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 30 * kDegree, 0);
  EXPECT_THROW(toLaserScan(o, 20), InputError);
}

}  // namespace
}  // namespace hybrid_slam
