#include "base/DeskewedScan.h"

#include <gtest/gtest.h>

#include "base/ScanState.h"
#include "testing/TestSweeps.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using test::SweptLaser;

/// Motion from the timestamp, 0 s, to the time of each beam.
std::vector<TPose2D> motionOf(const SweptLaser& laser, const test::Motion& motion) {
  std::vector<TPose2D> all;
  for (size_t i = 0; i < laser.beams; ++i)
    all.push_back(motion(laser.sweep * static_cast<double>(i) / static_cast<double>(laser.beams - 1)) -
                  motion(0));
  return all;
}

/// Turns on the spot at 1.5 rad/s.
TPose2D turning(double t) { return {1, -0.5, 0.3 + 1.5 * t}; }
/// Drives obliquely to the walls at 1 m/s.
TPose2D driving(double t) { return {0.8 * t, 0.6 * t, 0.3}; }
/// Drives and turns the other way.
TPose2D onAnArc(double t) { return {0.5 * std::cos(2 * t), -0.5 * std::sin(2 * t), 1 - 2 * t}; }

struct Case {
  const char* name;
  test::Motion motion;
  SweptLaser laser;
};

std::vector<Case> cases() {
  SweptLaser upright, reversed, upsideDown, both, circle;
  reversed.rightToLeft = false;
  upsideDown.sensorPose = mrpt::poses::CPose3D(0.3, -0.1, 0.2, 0.4, 0, M_PI);
  both = upsideDown;
  both.rightToLeft = false;
  circle.aperture = 2 * M_PI * 359 / 360;
  circle.beams = 360;
  std::vector<Case> all;
  for (const auto& [name, laser] : {std::pair{"upright", upright},
                                    {"reversed", reversed},
                                    {"upside down", upsideDown},
                                    {"upside down, reversed", both},
                                    {"full circle", circle}})
    for (const auto& motion : {turning, driving, onAnArc}) all.push_back({name, motion, laser});
  return all;
}

TEST(DeskewedScan, BeamsEndOnTheWallsWhateverTheMotionAndTheMounting) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto raw = test::sweptScan(c.laser, 0, c.motion);
    const auto scan = deskew(*raw, motionOf(c.laser, c.motion));
    EXPECT_GT(test::farthestFromWalls(*raw, c.motion(0)), 0.05) << "the motion shows in the raw scan";
    EXPECT_LT(test::farthestFromWalls(*scan, c.motion(0)), 1e-6);
    EXPECT_EQ(scan->timestamp, raw->timestamp);
  }
}

TEST(DeskewedScan, ATurnIsExactWithEqualStepsToo) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    SweptLaser laser = c.laser;
    laser.sensorPose.x(0), laser.sensorPose.y(0);  // else the sensor moves as well
    const auto scan = deskew(*test::sweptScan(laser, 0, turning), motionOf(laser, turning));
    const CObservation2DRangeScan forMrpt = *scan;  // as MRPT's code sees it, and files hold it
    EXPECT_LT(test::farthestFromWalls(forMrpt, turning(0)), 1e-5);
  }
}

TEST(DeskewedScan, InvalidBeamsTurnButKeepTheirRange) {
  const SweptLaser laser;
  const auto raw = test::sweptScan(laser, 0, turning);
  raw->setScanRange(180, 19.5F);
  raw->setScanRangeValidity(180, false);
  const auto scan = deskew(*raw, motionOf(laser, turning));
  EXPECT_EQ(scan->getScanRange(180), 19.5F);
  EXPECT_FALSE(scan->getScanRangeValidity(180));
  const LaserScan before = toLaserScan(*raw, 20), after = toLaserScan(*scan, 20);
  EXPECT_NEAR(after.sensorPose.phi + after.beams[180].angle,
              before.sensorPose.phi + before.beams[180].angle + 0.15, 1e-6);
}

TEST(DeskewedScan, ACopyKeepsTheAngles) {
  const SweptLaser laser;
  const auto raw = test::sweptScan(laser, 0, driving);
  const auto scan = deskew(*raw, motionOf(laser, driving));
  EXPECT_LT(test::farthestFromWalls(*copyOf(*scan), driving(0)), 1e-6);
  EXPECT_EQ(dynamic_cast<DeskewedScan*>(copyOf(*raw).get()), nullptr);
}

TEST(DeskewedScan, SessionsKeepTheAngles) {
  const SweptLaser laser;
  const auto raw = test::sweptScan(laser, 0, driving);
  Scans scans{raw, deskew(*raw, motionOf(laser, driving))}, read;
  std::string bytes;
  StateWriter{bytes}(scans);
  StateReader{bytes}(read);
  ASSERT_EQ(read.size(), 2);
  EXPECT_EQ(test::farthestFromWalls(*read[0], driving(0)), test::farthestFromWalls(*raw, driving(0)));
  EXPECT_EQ(test::farthestFromWalls(*read[1], driving(0)), test::farthestFromWalls(*scans[1], driving(0)));
}

TEST(DeskewedScan, OneBeamIsLeftAlone) {
  SweptLaser laser;
  laser.beams = 2;
  const auto raw = test::sweptScan(laser, 0, turning);
  raw->resizeScan(1);
  EXPECT_EQ(toLaserScan(*deskew(*raw, {{}}), 20).beams.size(), 1);
}

}  // namespace
}  // namespace hybrid_slam
