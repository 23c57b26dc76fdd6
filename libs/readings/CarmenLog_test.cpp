/// Rows of CARMEN's logs: odometry, lasers, broken rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "testing/LogRows.h"

namespace hybrid_slam::readings {
namespace {

using test::expectPose;
using test::kFlaser;
using test::parseAs;
using test::threeBeamOptions;
using test::whyBroken;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(LogParserCarmen, Odometry) {
  const std::string line = "ODOM 1.5 -2.25 0.5 0.1 -0.2 0 976052857.348896 host 12.5";
  const auto record = parseAs<OdometryRecord>(formatNamed("carmen"), line);
  EXPECT_DOUBLE_EQ(record.time, 976052857.348896);
  expectPose(record.pose, 1.5, -2.25, 0.5);

  LogParserOptions options;
  options.time = LogTime::logger;
  const auto parser = formatNamed("carmen")->makeParser(options);
  EXPECT_DOUBLE_EQ(parseAs<OdometryRecord>(*parser, line).time, 12.5);
}

TEST(LogParserCarmen, FrontLaser) {
  const auto record = parseAs<LaserRecord>(formatNamed("carmen"), kFlaser);
  EXPECT_EQ(record.label, "FLASER");
  EXPECT_DOUBLE_EQ(record.time, 976052857.348896);
  EXPECT_THAT(record.ranges, ElementsAre(1.5f, 81.83f, 2.25f));
  EXPECT_NEAR(record.angles.first, -M_PI / 2, 1e-12);
  EXPECT_NEAR(record.angles.step, M_PI / 2, 1e-12);
  expectPose(record.laserPose, 0, 0, 0);
  ASSERT_TRUE(record.odometry);
  expectPose(*record.odometry, -1.5, 2, 0.75);
  EXPECT_FALSE(record.maxRange);
}

TEST(LogParserCarmen, CommentsBlanksAndOtherRecordsAreSkipped) {
  for (const char* line : {"", "   \t\r", "# message_name [message contents]", "#FLASER 1"})
    parseAs<std::monostate>(formatNamed("carmen"), line);
  EXPECT_EQ(parseAs<OtherRecord>(formatNamed("carmen"), "SYNC tag 0 host 0").name, "SYNC");
}

/// The log of Orebro has the odometry in place of the laser's pose, zeros as the robot's, and one time.
TEST(LogParserCarmen, RowsWithoutIpcTimeHaveTheOdometryInPlaceOfTheLasersPose) {
  const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
  const auto record = parseAs<LaserRecord>(*parser, "FLASER 3 1 2 3 12 28 1.25 0 0 0 host 12.5");
  EXPECT_THAT(record.ranges, ElementsAre(1, 2, 3));
  EXPECT_EQ(record.time, 12.5);
  expectPose(*record.odometry, 12, 28, 1.25);
  expectPose(record.laserPose, 0, 0, 0);
  const std::string lacksRange = "FLASER 3 1 2 12 28 1.25 12 28 1.25 100.5 host 12.5";
  EXPECT_THAT(whyBroken(formatNamed("carmen"), lacksRange), HasSubstr("11 fields where 12"));
}

TEST(LogParserCarmen, WindowsLineEndsAndTabsAreAccepted) {
  EXPECT_EQ(parseAs<OdometryRecord>(formatNamed("carmen"), "ODOM\t1 2 3  0 0 0 +5 host 6\r").time, 5);
}

TEST(LogParserCarmen, BrokenLines) {
  for (const char* line : {"ODOM",
                           "ODOM 1 2 3",
                           "ODOM 1 2 3 0 0 0 5 host",
                           "ODOM 1 2 3 0 0 0 5 host 6 7",
                           "ODOM x 2 3 0 0 0 5 host 6",
                           "ODOM 1 2 3x 0 0 0 5 host 6",
                           "ODOM 1 2 nan 0 0 0 5 host 6",
                           "ODOM 1 inf 3 0 0 0 5 host 6",
                           "ODOM 1 2 3 0 0 0 -5 host 6",
                           "ODOM 1 2 3 0 0 0 1e300 host 6",
                           "ODOM 1 2 3 0 0 0 inf host 6",
                           "ODOM 1,5 2 3 0 0 0 5 host 6",
                           "ODOM 1e999 2 3 0 0 0 5 host 6",
                           "ODOM + 2 3 0 0 0 5 host 6",
                           "FLASER",
                           "FLASER 0 9 9 9 1 2 3 5 host 6",
                           "FLASER -3 1 2 3 9 9 9 1 2 3 5 host 6",
                           "FLASER 2.5 1 2 3 9 9 9 1 2 3 5 host 6",
                           "FLASER 4 1 2 3 9 9 9 1 2 3 5 host 6",
                           "FLASER 2 1 2 3 9 9 9 1 2 3 5 host 6",
                           "FLASER 3 1 b 3 9 9 9 1 2 3 5 host 6",
                           "FLASER 99999999999 1",
                           "PARAM",
                           "PARAM robot_frontlaser_offset",
                           "PARAM robot_frontlaser_offset ahead nohost 0",
                           "flaser 1 2",
                           "0.75 1 2",
                           "F\x01\xff 1"})
    EXPECT_THAT(whyBroken(formatNamed("carmen"), line), testing::Not(HasSubstr("not broken"))) << line;
}

/// A row truncated anywhere before its last number is never accepted.
TEST(LogParserCarmen, EveryTruncatedRowIsBroken) {
  for (size_t kept = kFlaser.rfind(' '); kept > 6; --kept)
    EXPECT_THAT(whyBroken(formatNamed("carmen"), kFlaser.substr(0, kept)),
                testing::Not(HasSubstr("not broken")));
}

TEST(LogParserCarmen, ReasonsNameWhatIsWrong) {
  EXPECT_EQ(whyBroken(formatNamed("carmen"), "ODOM 1 2 3 0 0 0 5 host"),
            "8 fields where 9 were expected: x y theta tv rv acceleration ipc_time host logger_time");
  EXPECT_EQ(whyBroken(formatNamed("carmen"), "ODOM 1 two 3 0 0 0 5 host 6"), "`two` is not a number");
  const auto parser = formatNamed("carmen")->makeParser({});
  try {
    parser->parse(kFlaser);
    FAIL() << "three beams without an angular step";
  } catch (const BrokenLine& e) {
    EXPECT_THAT(e.what(), HasSubstr("3 beams: the angular step must be given"));
  }
}

TEST(LogParserCarmen, UnusualReadingsAreNotBroken) {
  const auto record = parseAs<LaserRecord>(formatNamed("carmen"), "FLASER 3 nan inf -1 9 9 9 1 2 3 5 host 6");
  EXPECT_TRUE(std::isnan(record.ranges[0]));
  EXPECT_TRUE(std::isinf(record.ranges[1]));
  EXPECT_EQ(record.ranges[2], -1);
}

}  // namespace
}  // namespace hybrid_slam::readings
