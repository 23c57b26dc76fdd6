// Scans of a moving robot, corrected by ReadingAssembler.
#include <gtest/gtest.h>

#include "base/DeskewedScan.h"
#include "readings/ReadingAssembler.h"
#include "testing/TestSweeps.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;
using test::Log;
using test::SweptLaser;

/// Turns at 1.5 rad/s.
TPose2D turning(double t) { return {0.5, 0.2, 1.5 * (t - 100)}; }
TPose2D driving(double t) { return {0.5 * (t - 100), 0.4, 0.5}; }

std::vector<Reading> readingsOf(const Log& log, OdometrySource odometry, const SweepTimes& sweeps = {}) {
  ReadingAssembler assembler({}, odometry, 1, {sweeps});
  std::vector<Reading> all;
  for (const auto& object : log) assembler.take(object);
  assembler.finish();
  while (const auto reading = assembler.next()) all.push_back(*reading);
  return all;
}

Log stating(double seconds, Log log, const std::string& label = "LASER") {
  log.insert(log.begin(), commentOf({label, seconds}, test::stamp(100)));
  return log;
}

/// Scans at 100, 100.13, ... s, and odometry every 0.05 s, which begins before them and ends after them.
Log observations(const test::Motion& motion, const SweptLaser& laser = {}) {
  Log log;
  for (int i = -1, scans = 0; i < 26; ++i) {
    const double time = 100.02 + 0.05 * i;
    for (; scans < 9 && 100 + 0.13 * scans < time; ++scans)
      log.push_back(test::sweptScan(laser, 100 + 0.13 * scans, motion));
    log.push_back(test::odometry(time, motion(time)));
  }
  return log;
}

/// Pairs of a scan and the motion to it.
Log pairs(const test::Motion& motion) {
  Log log;
  for (int i = 0; i < 9; ++i) {
    const double time = 100 + 0.13 * i;
    log.push_back(i == 0 ? mrpt::obs::CActionCollection::Create()
                         : test::action(motion(time) - motion(time - 0.13)));
    log.push_back(test::frame({test::sweptScan({}, time, motion)}));
  }
  return log;
}

/// Returns the largest error of a scan (m).
double worst(const std::vector<Reading>& readings, const test::Motion& motion) {
  double all = 0;
  for (const Reading& reading : readings)
    all = std::max(all, test::farthestFromWalls(*reading.scans.back(), motion(reading.timestamp)));
  return all;
}

TEST(Deskewing, BeamsEndOnTheWallsForATurningAndADrivingRobot) {
  for (const auto& motion : {turning, driving})
    for (const bool asPairs : {false, true}) {
      const Log log = asPairs ? pairs(motion) : observations(motion);
      const OdometrySource odometry = asPairs ? OdometrySource::actions : OdometrySource::readings;
      const auto raw = readingsOf(log, odometry), corrected = readingsOf(stating(0.1, log), odometry);
      ASSERT_EQ(raw.size(), 9);
      ASSERT_EQ(corrected.size(), 9);
      EXPECT_GT(worst(raw, motion), 0.015);
      EXPECT_LT(worst(corrected, motion), 2e-6);
      for (size_t i = 0; i < 9; ++i) {
        EXPECT_EQ(corrected[i].timestamp, raw[i].timestamp);
        EXPECT_EQ(corrected[i].motion, raw[i].motion) << "only the beams differ";
      }
    }
}

TEST(Deskewing, OfAScanThatBeginsBeforeTheOdometry) {
  for (const auto& motion : {turning, driving}) {
    Log log = observations(motion);
    log.erase(log.begin());  // now the first scan is the first object
    ASSERT_TRUE(std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(log[0]));
    const auto corrected = readingsOf(stating(0.1, log), OdometrySource::readings);
    ASSERT_EQ(corrected.size(), 9);
    EXPECT_LT(test::farthestFromWalls(*corrected[0].scans[0], motion(100)), 2e-6);
    const TPose2D off = corrected[1].motion - (motion(100.13) - motion(100));
    EXPECT_NEAR(off.norm(), 0, 1e-6) << "from the first beam on";
    EXPECT_NEAR(off.phi, 0, 1e-6);
  }
}

TEST(Deskewing, ByTheSettingWithoutAWordInTheLog) {
  EXPECT_LT(worst(readingsOf(observations(turning), OdometrySource::readings, SweepTimes(0.1)), turning),
            2e-6);
  EXPECT_GT(worst(readingsOf(stating(0.1, observations(turning)), OdometrySource::readings, SweepTimes(0)),
                  turning),
            0.05);
}

TEST(Deskewing, AnUnknownOrImpossibleTimeLeavesTheScansAsTheyAre) {
  for (const double seconds : {0.0, -0.1, 1e9, std::nan("")}) {
    const Log log = stating(seconds, observations(turning));
    const std::vector<Reading> all = readingsOf(log, OdometrySource::readings);
    ASSERT_GT(all.size(), 1u);
    for (const Reading& reading : all)
      EXPECT_NE(std::find(log.begin(), log.end(), reading.scans.back()), log.end())
          << "the object of the log";
  }
}

TEST(Deskewing, UpsideDownAndReversed) {
  for (const bool rightToLeft : {false, true}) {
    SweptLaser laser;
    laser.sensorPose = mrpt::poses::CPose3D(0.3, -0.1, 0.2, 0.4, 0, M_PI);
    laser.rightToLeft = rightToLeft;
    EXPECT_LT(
        worst(readingsOf(stating(0.1, observations(turning, laser)), OdometrySource::readings), turning),
        2e-6);
  }
}

TEST(Deskewing, AScanOfAStandingRobotIsNotCopied) {
  const auto stands = [](double) { return TPose2D(1, 0, 0.5); };
  const Log log = stating(0.1, observations(stands));
  const std::vector<Reading> all = readingsOf(log, OdometrySource::readings);
  ASSERT_GT(all.size(), 1u);
  for (const Reading& reading : all)
    EXPECT_NE(std::find(log.begin(), log.end(), reading.scans.back()), log.end());
}

TEST(Deskewing, WaitsForTheOdometryUpToTheLastBeam) {
  ReadingAssembler assembler({}, OdometrySource::readings, 1, {SweepTimes(0.1)});
  assembler.take(test::odometry(100, turning(100)));
  assembler.take(test::sweptScan({}, 100, turning));
  assembler.take(test::odometry(100.06, turning(100.06)));
  EXPECT_FALSE(assembler.next());
  assembler.take(test::odometry(100.12, turning(100.12)));
  const auto reading = assembler.next();
  ASSERT_TRUE(reading);
  EXPECT_LT(test::farthestFromWalls(*reading->scans.back(), turning(100)), 2e-6);
}

TEST(Deskewing, TheLastVelocityHoldsWhereTheLogEnds) {
  const Log log{test::odometry(99.95, turning(99.95)), test::odometry(100.01, turning(100.01)),
                test::sweptScan({}, 100, turning)};
  EXPECT_LT(worst(readingsOf(log, OdometrySource::readings, SweepTimes(0.1)), turning), 2e-6);
}

TEST(Deskewing, ScansOutsideTheOdometryAreNotCorrected) {
  const auto early = test::sweptScan({}, 99, turning), late = test::sweptScan({}, 105, turning);
  const auto all =
      readingsOf({early, test::odometry(100, turning(100)), test::odometry(100.5, turning(100.5)), late},
                 OdometrySource::readings, SweepTimes(0.1));
  ASSERT_EQ(all.size(), 2);
  EXPECT_EQ(all[0].scans.back(), early);
  EXPECT_EQ(all[1].scans.back(), late);
}

/// Expects the scans of two lasers on the walls. The second laser scans 40 ms later than the first.
void expectTwoLasersCorrected(const SweptLaser& front, SweptLaser rear, const SweepTimes& sweeps) {
  rear.label = "REAR";
  rear.sensorPose = mrpt::poses::CPose3D(-0.3, 0, 0.2, M_PI, 0, 0);
  Log log;
  for (int i = 0; i < 8; ++i) {
    const double time = 100 + 0.2 * i;
    for (const double after : {0.0, 0.01}) log.push_back(test::odometry(time + after, turning(time + after)));
    log.push_back(test::sweptScan(front, time + 0.01, turning));
    log.push_back(test::sweptScan(rear, time + 0.05, turning));
  }
  log.push_back(test::odometry(101.8, turning(101.8)));
  size_t both = 0;
  for (const Reading& reading : readingsOf(log, OdometrySource::readings, sweeps))
    if (reading.scans.size() == 2) {
      ++both;
      for (const auto& scan : reading.scans)
        EXPECT_LT(test::farthestFromWalls(*scan, turning(reading.timestamp)), 5e-6);
    }
  EXPECT_GE(both, 7);
}

TEST(Deskewing, TwoLasersOfOneReading) { expectTwoLasersCorrected({}, {}, SweepTimes(0.1)); }

/// Both turn 5 times per second; the second sees half as much.
TEST(Deskewing, ARateGivesTwoLasersTheirOwnTimes) {
  SweptLaser rear;
  rear.aperture = M_PI / 2, rear.sweep = 0.05;
  expectTwoLasersCorrected({}, rear, SweepTimes(SweepSetting{std::nullopt, 5.0}));
}

}  // namespace
}  // namespace hybrid_slam::readings
