#include "study/simulation/Simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>

#include "base/Errors.h"
#include "readings/RawlogSource.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/Route.h"
#include "study/simulation/SimulationOutput.h"
#include "testing/CommaLocale.h"
#include "testing/TemporaryFile.h"

namespace hybrid_slam::simulation {
namespace {

using mrpt::math::TPose2D;
using testing::HasSubstr;

/// A room of 10 m x 6 m, and 20 s of straight runs, a turn on the spot, a wait and a curve in it.
struct TestDrive {
  BuildingPlan plan{{Wall::straight({0, 0}, {10, 0}), Wall::straight({10, 0}, {10, 6}),
                     Wall::straight({10, 6}, {0, 6}), Wall::straight({0, 6}, {0, 0})}};
  Route route = Route::load(
      test::TemporaryFile("start 1 1 0\nspeed 0.5\nturn_speed 45\nvia 5 1 1\ngo 5 4\nwait 1\ngo 3 4\n")
          .path());
  SimulationOptions options;
  LaserOptions laser;
  OdometryOptions odometry;

  SimulatedLog log() const { return simulate(plan, route, options, laser, odometry); }
  void makePerfect() {
    laser.noise = false;
    odometry.meanDd = odometry.meanTt = 1;
    odometry.meanTd = 0;
    odometry.sigmaDd = odometry.sigmaDt = odometry.sigmaCd = odometry.sigmaCt = 0;
    odometry.sigmaTd = odometry.sigmaTt = 0;
  }
};

/// The truth as ideal odometry: in the frame of the start.
TPose2D fromStart(const TestDrive& drive, const TPose2D& pose) { return pose - drive.route.poseAt(0); }

void expectSamePose(const TPose2D& a, const TPose2D& b, double position, double angle) {
  EXPECT_NEAR(a.x, b.x, position);
  EXPECT_NEAR(a.y, b.y, position);
  EXPECT_NEAR(std::remainder(a.phi - b.phi, 2 * M_PI), 0, angle);
}

TEST(Simulation, ScansAndOdometryComeAtTheirOwnRatesFromTheStartTime) {
  TestDrive drive;
  const SimulatedLog log = drive.log();
  ASSERT_EQ(log.scans.size(), static_cast<size_t>(drive.route.duration() * 5) + 1);
  ASSERT_EQ(log.groundTruth.size(), log.scans.size());
  ASSERT_EQ(log.odometryAtScans.size(), log.scans.size());
  for (size_t i = 0; i < log.scans.size(); ++i) {
    EXPECT_NEAR(mrpt::Clock::toDouble(log.scans[i]->timestamp), 1287388800 + 0.2 * static_cast<double>(i),
                1e-6);
    EXPECT_EQ(log.groundTruth[i].timestamp, log.scans[i]->timestamp);
    expectSamePose(log.groundTruth[i].pose, drive.route.poseAt(0.2 * static_cast<double>(i)), 1e-9, 1e-9);
  }
  for (size_t i = 0; i < log.odometry.size(); ++i)
    EXPECT_NEAR(mrpt::Clock::toDouble(log.odometry[i]->timestamp),
                1287388800.03 + 0.1 * static_cast<double>(i), 1e-6);
}

/// The ends of the beams, seen from the robot's true pose at each one's time, lie on the walls.
TEST(Simulation, BeamsAreMeasuredOneAfterAnother) {
  TestDrive drive;
  drive.makePerfect();
  drive.laser.scanTime = 0.15;
  const SimulatedLog log = drive.log();
  EXPECT_EQ(log.scanTime, 0.15);
  double farthest = 0;
  for (size_t k = 0; k + 1 < log.scans.size(); ++k) {
    const auto& scan = *log.scans[k];
    expectSamePose(log.groundTruth[k].pose, drive.route.poseAt(0.2 * static_cast<double>(k)), 1e-9, 1e-9);
    for (size_t i = 0; i < scan.getScanSize(); ++i) {
      const double after = 0.15 * static_cast<double>(i) / static_cast<double>(scan.getScanSize() - 1);
      const TPose2D sensor = drive.route.poseAt(0.2 * static_cast<double>(k) + after) + TPose2D(0.15, 0, 0);
      const double range = scan.getScanRange(i);
      const auto end = sensor.composePoint(
          {range * std::cos(scan.getScanAngle(i)), range * std::sin(scan.getScanAngle(i))});
      farthest = std::max(farthest, drive.plan.distanceToNearestWall(end));
    }
  }
  EXPECT_LT(farthest, 0.001) << "whole millimetres";
}

TEST(Simulation, TheRawlogStatesTheScanTime) {
  TestDrive drive;
  drive.options.scans = 3;
  for (const RawlogForm form : {RawlogForm::observations, RawlogForm::pairs})
    for (const double scanTime : {0.0, 0.15}) {
      drive.laser.scanTime = scanTime;
      const test::TemporaryFile file("");
      writeRawlog(toRawlog(drive.log(), form), file.path());
      const auto sweeps = readings::summarise(file.path(), {}).sweeps;
      if (scanTime == 0)
        EXPECT_TRUE(sweeps.empty());
      else
        EXPECT_EQ(sweeps.at("LASER"), 0.15);
    }
}

TEST(Simulation, AScanCannotTakeLongerThanTheTimeToTheNext) {
  TestDrive drive;
  drive.laser.scanTime = 0.25;
  try {
    drive.log();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("key `scan_time`; expected at most 1 / rate = 0.2 s"));
  }
}

TEST(SimulationOutput, TheGroundTruthIsTheSameInEveryLocale) {
  const test::CommaLocale german;
  const test::TemporaryFile file("");
  writeGroundTruth({{mrpt::Clock::fromDouble(1234.5), {0.5, -2, 0}}}, file.path());
  std::ifstream in(file.path());
  std::string row;
  std::getline(in, row);
  EXPECT_EQ(row, "1234.500000 0.500000 -2.000000 0 0 0 0.000000000 1.000000000");
}

TEST(Simulation, PerfectOdometryIsTheTruth) {
  TestDrive drive;
  drive.makePerfect();
  const SimulatedLog log = drive.log();
  const double angleStep = M_PI / 4096;  // rounding
  for (size_t i = 0; i < log.scans.size(); ++i)
    expectSamePose(log.odometryAtScans[i], fromStart(drive, log.groundTruth[i].pose), 0.00051,
                   angleStep * 1.01);
  for (const auto& reading : log.odometry) {
    const double time = mrpt::Clock::toDouble(reading->timestamp) - drive.options.startTime;
    expectSamePose(reading->odometry.asTPose(), fromStart(drive, drive.route.poseAt(time)), 0.00052,
                   angleStep * 1.02);
  }
}

TEST(Simulation, ASlipChangesTheOdometryFromItsTimeOn) {
  TestDrive drive;
  drive.makePerfect();
  const SimulatedLog without = drive.log();
  drive.odometry.slips = "3.1 25 0.1";
  const SimulatedLog with = drive.log();
  for (size_t i = 0; i < with.scans.size(); ++i) {
    EXPECT_EQ(with.groundTruth[i].pose, without.groundTruth[i].pose);
    const double turned = with.odometryAtScans[i].phi - without.odometryAtScans[i].phi;
    const double expected = 0.2 * static_cast<double>(i) < 3.1 ? 0 : mrpt::DEG2RAD(25.0);
    EXPECT_NEAR(std::remainder(turned - expected, 2 * M_PI), 0, 2.02 * M_PI / 4096) << i;
  }
}

TEST(Simulation, TheSameSeedIsTheSameLogAndAnotherIsNot) {
  TestDrive drive;
  const SimulatedLog a = drive.log(), b = drive.log();
  drive.options.seed = 2;
  const SimulatedLog c = drive.log();
  int different = 0;
  for (size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_EQ(a.odometryAtScans[i], b.odometryAtScans[i]);
    for (size_t k = 0; k < a.scans[i]->getScanSize(); ++k) {
      EXPECT_EQ(a.scans[i]->getScanRange(k), b.scans[i]->getScanRange(k));
      different += a.scans[i]->getScanRange(k) != c.scans[i]->getScanRange(k);
    }
  }
  EXPECT_GT(different, 1000);
  EXPECT_NE(a.odometryAtScans.back(), c.odometryAtScans.back());
}

TEST(Simulation, BothFormsOfRawlogHoldTheSameScansAndOdometry) {
  const TestDrive drive;
  const SimulatedLog log = drive.log();
  const auto observations = toRawlog(log, RawlogForm::observations);
  ASSERT_EQ(observations.size(), log.scans.size() + log.odometry.size());
  for (size_t i = 1; i < observations.size(); ++i)
    EXPECT_LE(observations.getAsObservation(i - 1)->timestamp, observations.getAsObservation(i)->timestamp);

  const auto pairs = toRawlog(log, RawlogForm::pairs);
  ASSERT_EQ(pairs.size(), 2 * log.scans.size());
  TPose2D pose = log.odometryAtScans.front();
  for (size_t i = 0; i < log.scans.size(); ++i) {
    const auto movement = pairs.getAsAction(2 * i)->getActionByClass<mrpt::obs::CActionRobotMovement2D>();
    ASSERT_TRUE(movement);
    EXPECT_EQ(movement->timestamp, log.scans[i]->timestamp);
    pose = pose + movement->rawOdometryIncrementReading.asTPose();
    expectSamePose(pose, log.odometryAtScans[i], 2e-4, 1e-4);  // increments are rounded to 1e-6
    const auto scan =
        pairs.getAsObservations(2 * i + 1)->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->getScanRange(100), log.scans[i]->getScanRange(100));
  }
}

TEST(Simulation, EndsAfterTheRequestedScans) {
  TestDrive drive;
  drive.options.scans = 17;
  EXPECT_EQ(drive.log().scans.size(), 17u);
  drive.options.scans = 1000;
  try {
    drive.log();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("section [simulation], key `scans`"));
  }
}

TEST(Simulation, ASlipAfterTheEndAndAPathThroughAWallAreErrors) {
  TestDrive drive;
  drive.odometry.slips = "1000 10 0";
  EXPECT_THROW(drive.log(), InputError);
  drive.odometry.slips.clear();
  drive.options.robotRadius = 1.5;
  EXPECT_THROW(drive.log(), InputError);
}

}  // namespace
}  // namespace hybrid_slam::simulation
