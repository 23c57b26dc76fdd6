/// Rows of the text logs other than CARMEN's, and the format that a row implies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "testing/LogRows.h"
#include "testing/TinyslamRows.h"

namespace hybrid_slam::readings {
namespace {

using test::expectPose;
using test::kFlaser;
using test::parseAs;
using test::threeBeamOptions;
using test::whyBroken;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(LogParserGfs, LaserReading) {
  const auto record = parseAs<LaserRecord>(formatNamed("gfs"),
                                           "LASER_READING 3 1.50 2.25 81.83 0.5 -0.25 1.25 976052857.348896");
  EXPECT_EQ(record.label, "LASER_READING");
  EXPECT_THAT(record.ranges, ElementsAre(1.5f, 2.25f, 81.83f));
  EXPECT_DOUBLE_EQ(record.time, 976052857.348896);
  ASSERT_TRUE(record.odometry);
  expectPose(*record.odometry, 0.5, -0.25, 1.25);
  EXPECT_THAT(whyBroken(formatNamed("gfs"), "LASER_READING 3 1.50 2.25 81.83 0.5 -0.25 1.25"),
              HasSubstr("6 fields where 7 were expected"));
}

/// GMapping combines the previous reading's pose with the new one's time.
TEST(LogParserGfs, OdometryGetsItsOwnTime) {
  const auto parser = formatNamed("gfs")->makeParser(threeBeamOptions());
  auto record = parseAs<OdometryRecord>(*parser, "ODOM 0 0 0 100");  // the first reading has its own time
  EXPECT_EQ(record.time, 100);
  parser->parse("ODO_UPDATE 1 0 0 0 1 100");
  record = parseAs<OdometryRecord>(*parser, "ODOM 0 0 0 101");
  EXPECT_EQ(record.time, 100);
  record = parseAs<OdometryRecord>(*parser, "ODOM 1 0 0 102");  // where the robot was at 101
  EXPECT_EQ(record.time, 101);
  EXPECT_EQ(record.pose.x, 1);
  parser->parse("FRAME 3 0.5 0.1");
  const auto scan = parseAs<LaserRecord>(*parser, "LASER_READING 3 4 5 6 2.0004 0 0 102");
  EXPECT_EQ(scan.odometry->x, 2.0004);
  parseAs<std::monostate>(*parser, "ODOM 2.000 0 0 103");  // the scan's pose again, rounded
  record = parseAs<OdometryRecord>(*parser, "ODOM 3 0 0 104");
  EXPECT_EQ(record.time, 103);
  EXPECT_THAT(whyBroken(formatNamed("gfs"), "ODOM 3 0 0"), HasSubstr("3 fields where 4"));
}

TEST(LogParserGfs, StatesOfTheParticlesAreSkipped) {
  for (const std::string name :
       {"ODO_UPDATE", "SM_UPDATE", "FRAME", "RESAMPLE", "NEFF", "ENTROPY", "SIMULATOR_POS", "COMMENT"})
    EXPECT_EQ(parseAs<OtherRecord>(formatNamed("gfs"), name + " 1 2 3").name, name);
}

TEST(LogParserDpslam, OneStepForEachPairOfRows) {
  LogParserOptions options = threeBeamOptions();
  options.period = 0.5;
  options.laserX = 0.4;
  const auto parser = formatNamed("dpslam")->makeParser(options);
  for (int step = 0; step < 3; ++step) {
    const auto odometry = parseAs<OdometryRecord>(*parser, "Odometry -2.5 4.75 2.5 ");
    EXPECT_EQ(odometry.time, 0.5 * step);
    expectPose(odometry.pose, -2.5, 4.75, 2.5);
    const auto scan = parseAs<LaserRecord>(*parser, "Laser 3 0.642 8.183 1.5 ");
    EXPECT_EQ(scan.time, 0.5 * step);
    EXPECT_EQ(scan.label, "LASER");
    EXPECT_THAT(scan.ranges, ElementsAre(0.642f, 8.183f, 1.5f));
    EXPECT_FALSE(scan.odometry);
    expectPose(scan.laserPose, 0.4, 0, 0);
  }
}

TEST(LogParserDpslam, AMissingRowDoesNotStopTheClock) {
  const auto parser = formatNamed("dpslam")->makeParser(threeBeamOptions());
  EXPECT_EQ(parseAs<LaserRecord>(*parser, "LASER 3 1 2 3").time, 0);
  EXPECT_EQ(parseAs<OdometryRecord>(*parser, "ODOMETRY 0 0 0").time, 1);
  EXPECT_THROW(parser->parse("Laser 3 1 2"), BrokenLine);
  EXPECT_EQ(parseAs<OdometryRecord>(*parser, "Odometry 0 0 0").time, 2);
  EXPECT_EQ(parseAs<LaserRecord>(*parser, "Laser 3 1 2 3").time, 2);
  EXPECT_EQ(parseAs<LaserRecord>(*parser, "Laser 3 1 2 3").time, 3);
  EXPECT_THAT(whyBroken(formatNamed("dpslam"), "SYNC"), HasSubstr("neither Odometry nor Laser"));
  EXPECT_THAT(whyBroken(formatNamed("dpslam"), "Odometry 1 2"), HasSubstr("2 fields where 3"));
}

/// A row with one return, straight ahead.
std::string tinyslamRow(int microseconds, int left, int right) {
  std::vector<int> ranges(test::kTinyslamBeams);
  ranges[341] = 1500;
  return test::tinyslamRow(microseconds, left, right, ranges);
}

/// A wheel turns once in 2000 ticks, 2 pi 0.077 m; the wheels are 0.33 m apart.
TEST(LogParserTinyslam, OdometryIsThatOfTheWheels) {
  const auto parser = formatNamed("tinyslam")->makeParser({});
  const auto first = parseAs<LaserRecord>(*parser, tinyslamRow(1500000, 234835, 231727));
  EXPECT_EQ(first.time, 1.5);
  EXPECT_EQ(first.ranges.size(), 682u);
  EXPECT_FLOAT_EQ(first.ranges[341], 1.5f);
  EXPECT_NEAR(first.angles.first + 341 * first.angles.step, 0, 1e-12);
  expectPose(first.laserPose, 0.145, 0, 0);
  expectPose(*first.odometry, 0, 0, 0);
  // A row's odometry is 0.15 s newer than its scan.
  const auto at = [&parser](int microseconds, int left, int right) {
    return *parseAs<LaserRecord>(*parser, tinyslamRow(microseconds, left, right)).odometry;
  };
  const double turn = 2 * M_PI * 0.077;
  expectPose(at(1600000, 236835, 233727), 0, 0, 0);
  expectPose(at(1700000, 238835, 235727), turn / 2, 0, 0);
  expectPose(at(2200000, 238835, 235727), 2 * turn, 0, 0);
  at(2300000, 238735, 235827);
  const double heading = 0.1 * turn / 0.33;
  expectPose(at(2500000, 238735, 235827), 2 * turn, 0, heading);
  // The clock steps back: no pose in between is known.
  expectPose(at(100000, 240735, 237827), (2 + std::cos(heading)) * turn, std::sin(heading) * turn, heading);
  EXPECT_THAT(whyBroken(formatNamed("tinyslam"), "1 2 3 4"), HasSubstr("fields where"));
  EXPECT_EQ(formatOf(tinyslamRow(1, 2, 3)), formatNamed("tinyslam"));
  EXPECT_EQ(formatOf(tinyslamRow(1, 2, 3) + " 0"), nullptr);
}

TEST(FormatOf, FollowsFromTheFirstSpecificRecord) {
  EXPECT_EQ(formatOf("ODOM 1 2 3 0 0 0 5 host 6"), formatNamed("carmen"));
  EXPECT_EQ(formatOf(kFlaser), formatNamed("carmen"));
  EXPECT_EQ(formatOf("ROBOTLASER1 0"), formatNamed("carmen"));
  EXPECT_EQ(formatOf("PARAM robot_frontlaser_offset 0.0 nohost 0"), formatNamed("carmen"));
  EXPECT_EQ(formatOf("ODOM 1 2 3 5"), formatNamed("gfs"));
  EXPECT_EQ(formatOf("LASER_READING 180 1"), formatNamed("gfs"));
  EXPECT_EQ(formatOf("Odometry 1 2 3"), formatNamed("dpslam"));
  EXPECT_EQ(formatOf("LASER 181 1"), formatNamed("dpslam"));
  for (const char* line : {"", "# FLASER", "NEFF 20", "ODOM 1 2", "hello", "<html>"})
    EXPECT_FALSE(formatOf(line)) << line;
}

TEST(LogFormats, AreNamedInTheHelpAndTheFileDialogs) {
  const std::string logs = robotLogs(), ranges = defaultMaxRanges();
  const std::vector<std::string> endings = logEndings();
  for (const LogFormat* format : logFormats()) {
    EXPECT_THAT(logs, HasSubstr(format->name));
    EXPECT_THAT(ranges, HasSubstr(format->name));
  }
  EXPECT_THAT(
      logs, testing::StartsWith("bag of ROS 1 or 2 (.bag, .db3, .mcap or folder), or text log of CARMEN, "));
  EXPECT_THAT(logs, testing::MatchesRegex(".*text log of .+, .+ or [^,]+; plain or compressed .*"));
  EXPECT_THAT(ranges, HasSubstr("CARMEN, GMapping .gfs: 80; DP-SLAM: 8.18"));
  for (const char* ending : {".rawlog", ".clf", ".log", ".gfs", ".dat", ".mcap", ".gz"})
    EXPECT_EQ(std::count(endings.begin(), endings.end(), ending), 1) << ending;
}

TEST(InBackquotes, IsShortAndPrintable) {
  EXPECT_EQ(inBackquotes("abc"), "`abc`");
  EXPECT_EQ(inBackquotes("a\x01\xc3"), "`a??`");
  EXPECT_EQ(inBackquotes(std::string(100, 'x')), "`" + std::string(24, 'x') + "...`");
}

}  // namespace
}  // namespace hybrid_slam::readings
