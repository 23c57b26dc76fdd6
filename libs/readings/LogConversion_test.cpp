#include "readings/LogConversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/Degree.h"
#include "base/Errors.h"
#include "base/LaserScan.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CRawlog;
using mrpt::obs::CSensoryFrame;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string odom(const std::string& pose, const std::string& time) {
  return "ODOM " + pose + " 0 0 0 " + time + " host 0\n";
}

/// A row of `beams` ranges: 1 m, 2 m, 3 m, ...
/// @param poses  the laser's and the robot's, or one for both
std::string laser(const std::string& name, size_t beams, const std::string& poses, const std::string& time) {
  std::string row = name + " " + std::to_string(beams);
  for (size_t i = 0; i < beams; ++i) row += " " + std::to_string(i + 1);
  const bool both = std::count(poses.begin(), poses.end(), ' ') == 5;
  return row + " " + poses + (both ? "" : " " + poses) + " " + time + " host 0\n";
}

struct Converted {
  LogSummary summary;
  CRawlog rawlog;
  std::vector<size_t> brokenLines;

  /// Returns "LABEL time" of each entry.
  std::vector<std::string> entries() const {
    std::vector<std::string> all;
    for (const auto& object : rawlog) {
      const auto observation = std::dynamic_pointer_cast<CObservation>(object);
      all.push_back(observation->sensorLabel + " " +
                    std::to_string(std::lround(mrpt::Clock::toDouble(observation->timestamp))));
    }
    return all;
  }
  CObservation2DRangeScan::Ptr scan(size_t i) { return rawlog.asObservation<CObservation2DRangeScan>(i); }
};

Converted convertFile(const std::string& path, const LogConversionOptions& options = {}) {
  const files::TemporaryFolder folder;
  Converted result;
  result.summary =
      convertLog(path, folder.path("out.rawlog"), options,
                 [&result](size_t number, const std::string&) { result.brokenLines.push_back(number); });
  EXPECT_TRUE(result.rawlog.loadFromRawLogFile(folder.path("out.rawlog")));
  return result;
}

Converted convert(const std::string& log, const LogConversionOptions& options = {}) {
  const files::TemporaryFolder folder;
  return convertFile(folder.write("in.log", log), options);
}

TEST(LogConversion, AStoppedOneLeavesNothing) {
  const files::TemporaryFolder folder, out;
  const std::string text =
                        folder.write("in.log", odom("0 0 0", "100") + laser("FLASER", 181, "1 0 0", "103")),
                    rawlog = folder.path("in.rawlog");
  const auto ignore = [](size_t, const std::string&) {};
  convertLog(text, rawlog, {}, ignore);
  LogConversionOptions options;
  options.isStopped = [] { return true; };
  for (const std::string& log : {text, rawlog}) {
    EXPECT_THAT([&] { convertLog(log, out.path("out.rawlog"), options, ignore); },
                testing::ThrowsMessage<std::runtime_error>("interrupted: " + log + "; nothing was written"));
    EXPECT_TRUE(std::filesystem::is_empty(out.path("")));
  }
}

TEST(LogConversion, KeepsOrderAndTimesThatStepBack) {
  auto result =
      convert(odom("0 0 0", "100.25") + laser("FLASER", 181, "1 0 0", "103.123456") + odom("2 0 0", "101.5") +
              laser("FLASER", 181, "2 0 0", "101.5") + odom("3 4 0", "100"));
  EXPECT_THAT(result.entries(), ElementsAre("ODOMETRY 100", "ODOMETRY 103", "FLASER 103", "ODOMETRY 102",
                                            "FLASER 102", "ODOMETRY 100"));
  EXPECT_NEAR(mrpt::Clock::toDouble(result.scan(2)->timestamp), 103.123456, 1e-7);
  EXPECT_EQ(result.rawlog.asObservation<CObservationOdometry>(1)->timestamp, result.scan(2)->timestamp);
  EXPECT_EQ(result.summary.scans, 2u);
  EXPECT_EQ(result.summary.odometryReadings, 4u);
  EXPECT_DOUBLE_EQ(result.summary.earliest, 100);
  EXPECT_DOUBLE_EQ(result.summary.latest, 103.123456);
  EXPECT_DOUBLE_EQ(result.summary.pathLength, 1 + 1 + std::hypot(1, 4));
  EXPECT_EQ(result.summary.brokenLines, 0u);
}

TEST(LogConversion, TimesOfTodayKeepTheirMicroseconds) {
  auto result = convert(laser("FLASER", 181, "0 0 0", "1134864629.895182"));
  EXPECT_NEAR(mrpt::Clock::toDouble(result.scan(1)->timestamp), 1134864629.895182, 5e-7);
}

TEST(LogConversion, AScansOdometryIsWrittenUnlessIdentical) {
  const auto entries = [](const std::string& log) { return convert(log).entries(); };
  const std::string scan = laser("FLASER", 181, "1 2 3", "10");
  EXPECT_THAT(entries(scan), ElementsAre("ODOMETRY 10", "FLASER 10"));
  EXPECT_THAT(entries(odom("1 2 3", "10") + scan), ElementsAre("ODOMETRY 10", "FLASER 10"));
  EXPECT_THAT(entries(odom("1 2 3.001", "10") + scan),
              ElementsAre("ODOMETRY 10", "ODOMETRY 10", "FLASER 10"));
  EXPECT_THAT(entries(odom("1 2 3", "9") + scan), ElementsAre("ODOMETRY 9", "ODOMETRY 10", "FLASER 10"));
  EXPECT_THAT(entries(scan + laser("RLASER", 181, "1 2 3", "10")),
              ElementsAre("ODOMETRY 10", "FLASER 10", "RLASER 10"));
}

void expectFan(const LaserScan& scan, double firstDeg, double lastDeg) {
  EXPECT_NEAR((scan.sensorPose.phi + scan.beams.front().angle) / kDegree, firstDeg, 1e-5);
  EXPECT_NEAR((scan.sensorPose.phi + scan.beams.back().angle) / kDegree, lastDeg, 1e-5);
  EXPECT_EQ(scan.beams.front().range, 1);
  EXPECT_EQ(scan.beams.back().range, static_cast<double>(scan.beams.size()));
}

TEST(LogConversion, BeamsPointWhereTheLaserSentThem) {
  LogConversionOptions options;
  options.maxRange = 1000;
  const auto fan = [&options](size_t beams, const std::string& name = "FLASER") {
    return toLaserScan(*convert(laser(name, beams, "0 0 0", "1"), options).scan(1), 1000);
  };
  expectFan(fan(180), -90, 89);
  expectFan(fan(181), -90, 90);
  expectFan(fan(360), -90, 89.5);
  expectFan(fan(361), -90, 90);
  expectFan(fan(541), -135, 135);
  expectFan(fan(180, "RLASER"), 90, 269);
  options.angularStep = 0.25 * kDegree;
  expectFan(fan(361), -45, 45);
  expectFan(fan(180), -22.5, 22.25);
  // All beams in between, for 180 beams.
  options.angularStep.reset();
  const LaserScan scan = fan(180);
  for (size_t i = 0; i < 180; ++i) {
    EXPECT_NEAR((scan.sensorPose.phi + scan.beams[i].angle) / kDegree, -90 + static_cast<double>(i), 1e-5);
    EXPECT_TRUE(scan.beams[i].valid);
  }
}

TEST(LogConversion, MountsTheLaser) {
  auto result =
      convert("PARAM robot_frontlaser_offset 0.40 nohost 0\nPARAM robot_rearlaser_offset -0.3 x 0\n" +
              laser("FLASER", 181, "9 9 0 0 0 0", "1") + laser("RLASER", 180, "9 9 0 0 0 0", "1"));
  const LaserScan front = toLaserScan(*result.scan(1), 80), rear = toLaserScan(*result.scan(2), 80);
  EXPECT_NEAR(front.sensorPose.x, 0.4, 1e-12);
  EXPECT_NEAR(front.sensorPose.phi, 0, 1e-7);
  EXPECT_NEAR(rear.sensorPose.x, -0.3, 1e-12);
  EXPECT_NEAR(std::remainder(rear.sensorPose.phi - 179.5 * kDegree, 2 * M_PI), 0, 1e-7);
}

TEST(LogConversion, RobotLaserFanAboutItsOwnAxis) {
  auto result =
      convert("ROBOTLASER1 0 -1.0 2.0 0.5 30 0.01 0 3 4 29.5 31 0 0 0 0 0 0 0 0 0 0 0 0 5 host 6\n");
  const auto scan = result.scan(1);
  EXPECT_EQ(scan->maxRange, 30);
  const LaserScan seen = toLaserScan(*scan, 100);
  EXPECT_NEAR(seen.sensorPose.phi + seen.beams[0].angle, -1.0, 1e-6);
  EXPECT_NEAR(seen.sensorPose.phi + seen.beams[2].angle, 0.0, 1e-6);
  EXPECT_TRUE(seen.beams[1].valid);
  EXPECT_FALSE(seen.beams[2].valid);
}

std::vector<bool> validity(const CObservation2DRangeScan& scan) {
  std::vector<bool> valid;
  for (size_t i = 0; i < scan.getScanSize(); ++i) valid.push_back(scan.getScanRangeValidity(i));
  return valid;
}

TEST(LogConversion, NoReturnIsInvalid) {
  LogConversionOptions options;
  options.angularStep = kDegree;
  const std::string log = "FLASER 9 81.83 81.91 80 79.99 0 -1 nan inf 0.01 0 0 0 0 0 0 1 host 0\n";
  auto result = convert(log, options);
  EXPECT_THAT(validity(*result.scan(1)),
              ElementsAre(false, false, false, true, false, false, false, false, true));
  for (size_t i = 0; i < 9; ++i) EXPECT_TRUE(std::isfinite(result.scan(1)->getScanRange(i)));
  EXPECT_EQ(result.summary.longestRange, 79.99f);
  options.maxRange = 10;
  EXPECT_THAT(validity(*convert(log, options).scan(1)),
              ElementsAre(false, false, false, false, false, false, false, false, true));
  options.maxRange = 100;
  EXPECT_THAT(validity(*convert(log, options).scan(1)),
              ElementsAre(true, true, true, true, false, false, false, false, true));
}

TEST(LogConversion, DpslamsLaserEndsAtEightMetres) {
  LogConversionOptions options;
  options.angularStep = kDegree;
  options.laserX = 0.4;
  auto result = convert("Odometry 0 0 0\nLaser 3 8.17 8.183 1\nOdometry 1 0 0\nLaser 3 1 1 1\n", options);
  EXPECT_THAT(result.entries(), ElementsAre("ODOMETRY 0", "LASER 0", "ODOMETRY 1", "LASER 1"));
  EXPECT_THAT(validity(*result.scan(1)), ElementsAre(true, false, true));
  EXPECT_NEAR(result.scan(1)->sensorPose.x(), 0.4, 1e-12);
  EXPECT_EQ(result.summary.format, "DP-SLAM");
}

TEST(LogConversion, GfsLogFromItsContent) {
  LogConversionOptions options;
  options.angularStep = kDegree;
  auto result = convert(
      "ODOM 0.000 0.000 0.000000 100.000000\nODO_UPDATE 1 0 0 0 0 100\nFRAME 0 0 0\n"
      "ODOM 0.000 0.000 0.000000 101.000000\nFRAME 1 1 0\nLASER_READING 3 1.00 2.00 81.83 1 0 0.5 "
      "101.000000\n"
      "SM_UPDATE 1 1 0 0.5 7 \nNEFF 1.000000\nODOM 1.000 0.000 0.500000 102.000000\n"
      "ODOM 2.000 0.000 0.500000 103.000000\n",
      options);
  EXPECT_THAT(result.entries(), ElementsAre("ODOMETRY 100", "ODOMETRY 100", "ODOMETRY 101",
                                            "LASER_READING 101", "ODOMETRY 102"));
  EXPECT_THAT(validity(*result.scan(3)), ElementsAre(true, true, false));
  EXPECT_EQ(result.summary.format, "GMapping .gfs");
  EXPECT_EQ(result.summary.otherRecords.at("FRAME"), 2u);
}

TEST(LogConversion, BrokenLinesAreCountedWithTheirNumbers) {
  const std::string log = "# a comment\nODOM 1 2\n" + laser("FLASER", 181, "0 0 0", "1") +
                          "\nFLASER 181 1 2 3\n" + odom("1 0 0", "2") + "FLASER 181 1";
  auto result = convert(log);
  EXPECT_THAT(result.brokenLines, ElementsAre(2, 5, 7));
  EXPECT_EQ(result.summary.brokenLines, 3u);
  EXPECT_THAT(result.entries(), ElementsAre("ODOMETRY 1", "FLASER 1", "ODOMETRY 2"));

  LogConversionOptions strict;
  strict.strict = true;
  const std::string error = test::errorOf([&] { convert(log, strict); });
  EXPECT_THAT(error, HasSubstr("broken line: "));
  EXPECT_THAT(error, HasSubstr("in.log, line 2; 2 fields where 9 were expected"));
}

TEST(LogConversion, OtherRecordsAreCountedByName) {
  const auto result = convert("SYNC a\nSYNC b\n" + laser("FLASER", 181, "0 0 0", "1") + "TRUEPOS 0 0 0\n");
  EXPECT_EQ(result.summary.otherRecords, (std::map<std::string, size_t>{{"SYNC", 2}, {"TRUEPOS", 1}}));
  EXPECT_THAT(result.brokenLines, IsEmpty());
}

TEST(LogConversion, LasersThatAreNotUsedAreNoted) {
  const auto result = convert(laser("FLASER", 181, "0 0 0", "1") + "LASER3 2 1 2 1 host 0\n");
  EXPECT_THAT(result.summary.notes,
              ElementsAre("laser `LASER3` is not used: the log does not state its pose on the robot"));
}

TEST(LogConversion, OtherRecordsOfManyNamesTakeLittleMemory) {
  std::string log = laser("FLASER", 181, "0 0 0", "1");
  for (int i = 0; i < 200; ++i) log += "NAME" + std::to_string(i) + " a\n";
  const auto records = convert(log + "NAME0 a\n").summary.otherRecords;
  EXPECT_EQ(records.size(), 101u);
  EXPECT_EQ(records.at("NAME0"), 2u);
  EXPECT_EQ(records.at("of other names"), 100u);
}

TEST(LogConversion, AGivenFormatOverridesTheContent) {
  LogConversionOptions options;
  options.format = formatNamed("dpslam");
  EXPECT_THROW(convert(laser("FLASER", 181, "0 0 0", "1"), options), InputError);
}

TEST(LogConversion, ActionObservationPairsAddUpToTheOdometry) {
  LogConversionOptions options;
  options.actionObservation = true;
  auto result = convert(odom("1 1 0", "1") + laser("FLASER", 181, "1 1 0", "1") + odom("2 1 0", "2") +
                            laser("FLASER", 181, "2 2 1.5", "3") + laser("FLASER", 181, "2 2 1.5", "4"),
                        options);
  ASSERT_EQ(result.rawlog.size(), 6u);
  const auto movement = [&result](size_t i) {
    const auto actions = std::dynamic_pointer_cast<CActionCollection>(result.rawlog.getAsGeneric(i));
    return actions->getActionByClass<CActionRobotMovement2D>()->rawOdometryIncrementReading;
  };
  const auto expectMovement = [&](size_t i, double x, double y, double phi) {
    EXPECT_NEAR(movement(i).x(), x, 1e-9);
    EXPECT_NEAR(movement(i).y(), y, 1e-9);
    EXPECT_NEAR(movement(i).phi(), phi, 1e-9);
  };
  expectMovement(0, 0, 0, 0);
  expectMovement(2, 1, 1, 1.5);
  expectMovement(4, 0, 0, 0);
  for (const size_t i : {1u, 3u, 5u}) {
    const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(result.rawlog.getAsGeneric(i));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->getObservationByClass<CObservation2DRangeScan>()->getScanSize(), 181u);
  }
}

TEST(LogConversion, AFailureLeavesNoFile) {
  const files::TemporaryFolder folder;
  const auto ignore = [](size_t, const std::string&) {};
  const auto errorOf = [&](const std::string& in, const std::string& out) {
    return test::errorOf([&] { convertLog(in, out, {}, ignore); });
  };
  const std::string out = folder.path("out.rawlog");
  EXPECT_THAT(errorOf(folder.path("none"), out), HasSubstr("no such file"));
  EXPECT_THAT(errorOf(folder.write("empty", ""), out), HasSubstr("not a robot log"));
  EXPECT_THAT(errorOf(folder.write("text", "hello\nworld\n"), out), HasSubstr("not a robot log"));
  EXPECT_THAT(errorOf(folder.write("odometry", odom("1 2 3", "4")), out), HasSubstr("no laser scan"));
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_FALSE(std::filesystem::exists(folder.path(".partial.out.rawlog")));
  const std::string good = folder.write("good", laser("FLASER", 181, "0 0 0", "1"));
  EXPECT_THAT(errorOf(good, good), HasSubstr("the output is the input"));
  EXPECT_THAT(errorOf(good, folder.path("none/out.rawlog")), HasSubstr("cannot write"));
  EXPECT_EQ(errorOf(good, out), "no error");
}

/// Tests on the public logs of doc/datasets.md.
class PublicLogs : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("HYBRID_SLAM_DATASETS");
    if (!folder) GTEST_SKIP() << "HYBRID_SLAM_DATASETS does not name the folder of the public logs";
    folder_ = folder;
  }
  Converted convertWhole(const std::string& name, size_t scans, size_t beams) {
    Converted result = convertFile(folder_ + "/" + name);
    EXPECT_EQ(result.summary.scans, scans);
    EXPECT_EQ(result.summary.odometryReadings, scans);
    EXPECT_THAT(result.brokenLines, IsEmpty());
    EXPECT_EQ(result.rawlog.size(), 2 * scans);
    for (size_t i = 0; i < scans; ++i) {
      EXPECT_EQ(result.scan(2 * i + 1)->getScanSize(), beams);
      EXPECT_EQ(result.scan(2 * i + 1)->timestamp,
                result.rawlog.asObservation<CObservationOdometry>(2 * i)->timestamp);
    }
    return result;
  }
  std::string folder_;
};

TEST_F(PublicLogs, Intel) {
  auto result = convertWhole("intel-lab.clf.gz", 4653, 180);
  size_t stepsBack = 0, repeats = 0;
  for (size_t i = 1; i < 4653; ++i) {
    const auto before = result.scan(2 * i - 1)->timestamp, now = result.scan(2 * i + 1)->timestamp;
    stepsBack += now < before;
    repeats += now == before;
  }
  EXPECT_EQ(stepsBack, 217u);
  EXPECT_EQ(repeats, 52u);
  EXPECT_NEAR(mrpt::Clock::toDouble(result.scan(1)->timestamp), 976052857.348896, 5e-7);
}

TEST_F(PublicLogs, Csail) { convertWhole("csail.clf.gz", 1051, 361); }

TEST_F(PublicLogs, DpslamLoop) {
  auto result = convertWhole("dpslam-loop5.clf.gz", 551, 181);
  EXPECT_NEAR(result.scan(1)->sensorPose.x(), 0.4, 1e-6);  // the rows have six decimals
}

// The robot may still write the log, or another one may be copied over it.
TEST(LogConversion, ALogThatIsReplacedOrGrowsMeanwhileIsAnError) {
  for (const bool isReplaced : {true, false}) {
    const files::TemporaryFolder folder;
    std::string rows;
    for (int i = 0; i < 100; ++i) rows += laser("FLASER", 181, "0 0 0", std::to_string(i));
    const std::string log = folder.write("in.clf", rows), other = folder.write("other.clf", rows);
    LogConversionOptions options;
    options.isStopped = [&, calls = 0]() mutable {
      if (++calls != 50) return false;
      if (isReplaced)
        std::filesystem::rename(other, log);
      else
        std::ofstream(log, std::ios::app) << rows;
      return false;
    };
    EXPECT_EQ(test::errorOf<std::runtime_error>(
                  [&] { convertLog(log, folder.path("out.rawlog"), options, [](size_t, const auto&) {}); }),
              "log has changed while it was read: " + log + "; nothing was written");
    EXPECT_FALSE(std::filesystem::exists(folder.path("out.rawlog")));
  }
}

}  // namespace
}  // namespace hybrid_slam::readings
