#include "readings/LaserPose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "base/LaserScan.h"
#include "testing/ReplayedLog.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::DEG2RAD;
using test::scan;

TEST(LaserPose, IsParsed) {
  EXPECT_FALSE(laserPoseIn("auto"));
  const auto upright = laserPoseIn("0.2, -0.1, 180").value();
  EXPECT_EQ(upright.x(), 0.2);
  EXPECT_EQ(upright.y(), -0.1);
  EXPECT_NEAR(std::abs(upright.yaw()), DEG2RAD(180.0), 1e-12);
  EXPECT_EQ(upright.roll(), 0);
  EXPECT_NEAR(std::abs(laserPoseIn("0,0,0,180").value().roll()), DEG2RAD(180.0), 1e-12);
}

TEST(LaserPose, OtherTextIsAnError) {
  for (const char* text :
       {"", "1,2", "1,2,3,4", "1,2,3,180,5", "1,2,x", "nan,0,0", "101,0,0", "0,0,361", "0,0,0,90"})
    EXPECT_THROW(laserPoseIn(text), InputError) << text;
}

/// The log states no pose of the laser and calls it tilted. With the true pose, its beams end on the walls.
TEST(LaserPose, ReplacesThatOfTheLog) {
  const mrpt::math::TPose2D onRobot(0.2, 0.1, DEG2RAD(170.0));
  test::Log log;
  for (int i = 0; i < 4; ++i) {
    const mrpt::math::TPose2D pose(0.1 * i, 0.02 * i, 0.05 * i);
    log.push_back(test::odometry(10 + i, pose));
    log.push_back(scan(10 + i, pose + onRobot));
    std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(log.back())->sensorPose =
        mrpt::poses::CPose3D(0, 0, 0, 0, 0.5, 0);
    log.push_back(scan(10 + i, {}, 5, "rear"));
  }
  InputOptions options;
  options.sensorLabel = "LASER";
  EXPECT_THAT(test::replayed(log, options).error, testing::HasSubstr("tilted"));
  options.sensorLabel = "";
  options.laserPose = "0.2, 0.1, 170";
  const test::Replayed r = test::replayed(log, options);
  EXPECT_THAT(r.summary.lasers, testing::ElementsAre("LASER"));
  EXPECT_THAT(r.summary.ignored,
              testing::ElementsAre("laser `rear` is not used: [input] laser_pose is the pose of one laser"));
  ASSERT_EQ(r.allScans.size(), 4u);
  for (size_t i = 0; i < r.allScans.size(); ++i) {
    ASSERT_EQ(r.allScans[i].size(), 1u);
    const LaserScan seen = toLaserScan(*r.allScans[i][0], 100);
    for (const Beam& beam : seen.beams) {
      const auto end = r.poses[i].composePoint(seen.sensorPose.composePoint(
          {beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle)}));
      ASSERT_LT(std::min(std::abs(std::abs(end.x) - test::kHalfLength),
                         std::abs(std::abs(end.y) - test::kHalfWidth)),
                1e-4);
    }
  }
}

/// A recording of the same objects keeps the scans as measured.
TEST(LaserPose, LeavesTheObjectsOfTheLog) {
  ReadingAssembler assembler({}, OdometrySource::readings, 1, {{}, laserPoseIn("1, 0, 0, 180")});
  const auto measured = scan(10);
  for (const auto& object : test::Log{test::odometry(10, {}), measured, test::odometry(11, {})})
    assembler.take(object);
  const auto reading = assembler.next();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->scans[0]->sensorPose.x(), 1);
  EXPECT_EQ(measured->sensorPose.x(), 0);
  const LaserScan logged = toLaserScan(*measured, 100), mirrored = toLaserScan(*reading->scans[0], 100);
  ASSERT_EQ(mirrored.beams.size(), logged.beams.size());
  for (size_t i = 0; i < logged.beams.size(); ++i)
    EXPECT_EQ(mirrored.beams[i].range, logged.beams[logged.beams.size() - 1 - i].range) << "beam " << i;
}

}  // namespace
}  // namespace hybrid_slam::readings
