#include "readings/LogFormats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <cmath>

#include "readings/LogFields.h"

namespace hybrid_slam::readings {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegree = mrpt::DEG2RAD(1.0);

LogParserOptions threeBeamOptions() {
  LogParserOptions options;
  options.angularStep = 90 * kDegree;
  return options;
}

/// Parses a line, which must be a record of this type.
template <class Record>
Record parseAs(LogParser& parser, const std::string& line) {
  return std::get<Record>(parser.parse(line));
}

template <class Record>
Record parseAs(const LogFormat* format, const std::string& line) {
  const auto parser = format->makeParser(threeBeamOptions());
  return parseAs<Record>(*parser, line);
}

std::string whyBroken(const LogFormat* format, const std::string& line) {
  const auto parser = format->makeParser(threeBeamOptions());
  try {
    parser->parse(line);
  } catch (const BrokenLine& e) {
    return e.what();
  }
  return "not broken: " + line;
}

void expectPose(const mrpt::math::TPose2D& pose, double x, double y, double phi) {
  EXPECT_NEAR(pose.x, x, 1e-12);
  EXPECT_NEAR(pose.y, y, 1e-12);
  EXPECT_NEAR(std::remainder(pose.phi - phi, 2 * M_PI), 0, 1e-12);
}

const std::string kFlaser = "FLASER 3 1.5 81.83 2.25 9 9 9 -1.5 2 0.75 976052857.348896 host 12.5";

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

TEST(LogParserCarmen, RearLaserLooksBackwards) {
  const auto record = parseAs<LaserRecord>(formatNamed("carmen"), "R" + kFlaser.substr(1));
  EXPECT_EQ(record.label, "RLASER");
  expectPose(record.laserPose, 0, 0, M_PI);
}

TEST(LogParserCarmen, ParametersApplyToLaterRows) {
  const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
  expectPose(parseAs<LaserRecord>(*parser, kFlaser).laserPose, 0, 0, 0);
  parseAs<std::monostate>(*parser, "PARAM robot_frontlaser_offset 0.40 nohost 0");
  parseAs<std::monostate>(*parser, "PARAM robot_rearlaser_offset -0.25 976052857.3 host 0.1");
  parseAs<std::monostate>(*parser, "PARAM robot_name pioneer nohost 0");
  parseAs<std::monostate>(*parser, "PARAM joystick_names");
  expectPose(parseAs<LaserRecord>(*parser, kFlaser).laserPose, 0.4, 0, 0);
  expectPose(parseAs<LaserRecord>(*parser, "R" + kFlaser.substr(1)).laserPose, -0.25, 0, M_PI);
}

/// An `FLASER` row of a robot at (x, y) that faces +y.
std::string facingLeft(const std::string& laser, const std::string& robot) {
  return "FLASER 3 1 2 3 " + laser + " 1.5707963267948966 " + robot + " 1.5707963267948966 5 host 1";
}

TEST(LogParserCarmen, RowsThatAgreeTellTheMounting) {
  const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
  parser->parse("PARAM robot_frontlaser_offset 0.40 nohost 0");
  expectPose(parseAs<LaserRecord>(*parser, facingLeft("1.9 1.3", "2 1")).laserPose, 0.3, 0.1, 0);
  expectPose(parseAs<LaserRecord>(*parser, facingLeft("6.9 8.3", "7 8")).laserPose, 0.3, 0.1, 0);
}

TEST(LogParserCarmen, CorrectedRowsDoNotTellTheMounting) {
  const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
  parser->parse("PARAM robot_frontlaser_offset 0.40 nohost 0");
  expectPose(parseAs<LaserRecord>(*parser, facingLeft("0 0", "0 0")).laserPose, 0, 0, 0);
  expectPose(parseAs<LaserRecord>(*parser, facingLeft("1 0", "1.01 0")).laserPose, 0.4, 0, 0);
  expectPose(parseAs<LaserRecord>(*parser, facingLeft("2 0", "2 0")).laserPose, 0.4, 0, 0);
}

TEST(LogParserCarmen, LaserXOverridesTheFrontOffsetAlone) {
  LogParserOptions options = threeBeamOptions();
  options.laserX = 0.1;
  const auto parser = formatNamed("carmen")->makeParser(options);
  parser->parse("PARAM robot_frontlaser_offset 0.40 nohost 0");
  parser->parse("PARAM robot_rearlaser_offset -0.25 nohost 0");
  expectPose(parseAs<LaserRecord>(*parser, kFlaser).laserPose, 0.1, 0, 0);
  expectPose(parseAs<LaserRecord>(*parser, "R" + kFlaser.substr(1)).laserPose, -0.25, 0, M_PI);
}

/// The robot stands at (2, 1) facing +y; the laser, 0.3 m ahead and 0.1 m to the left, at (1.9, 1.3).
TEST(LogParserCarmen, RobotLaserCarriesItsOwnGeometry) {
  const std::string head = "ROBOTLASER1 0 -1.0 2.0 0.5 30.0 0.01 0 3 4 5 6 ";
  const std::string tail =
      " 1.9 1.3 1.670796326794897 2 1 1.570796326794897 0.2 0.1 0.55 0.375 1000000.0 "
      "100.25 host 7.5";
  for (const std::string remissions : {"0", "2 17 18"}) {
    const auto record = parseAs<LaserRecord>(formatNamed("carmen"), head + remissions + tail);
    EXPECT_EQ(record.label, "ROBOTLASER1");
    EXPECT_EQ(record.time, 100.25);
    EXPECT_THAT(record.ranges, ElementsAre(4, 5, 6));
    EXPECT_EQ(record.angles.first, -1.0);
    EXPECT_EQ(record.angles.step, 0.5);  // its own, not the default for scans without one
    EXPECT_EQ(record.maxRange, 30.0);
    expectPose(record.laserPose, 0.3, 0.1, 0.1);
    ASSERT_TRUE(record.odometry);
    expectPose(*record.odometry, 2, 1, M_PI / 2);
  }
  EXPECT_THAT(whyBroken(formatNamed("carmen"), head + "1" + tail), HasSubstr("fields where"));
  EXPECT_THAT(whyBroken(formatNamed("carmen"), head), HasSubstr("truncated line"));
  EXPECT_THAT(whyBroken(formatNamed("carmen"), "ROBOTLASER1 0 -1.0 2.0 0 30.0 0.01 0 3 4 5 6 0" + tail),
              HasSubstr("angular resolution"));
}

TEST(LogParserCarmen, CommentsBlanksAndOtherRecordsAreSkipped) {
  for (const char* line : {"", "   \t\r", "# message_name [message contents]", "#FLASER 1"})
    parseAs<std::monostate>(formatNamed("carmen"), line);
  EXPECT_EQ(parseAs<OtherRecord>(formatNamed("carmen"), "SYNC tag 0 host 0").name, "SYNC");
}

/// CARMEN logs the same scan as RAWLASER1 and, with the robot's pose, as ROBOTLASER1.
TEST(LogParserCarmen, LasersWithoutThePoseOfTheRobotAreUsedWhereThereAreNoOthers) {
  const std::string raw = "RAWLASER2 0 -1.0 2.0 0.5 30.0 0.01 0 3 4 5 6 1 17 100.25 host 7.5";
  const std::string plain = "LASER3 3 1 2 3 100.5 host 7.5";
  const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
  parser->parse("PARAM robot_rearlaser_offset -0.25 nohost 0");
  auto record = parseAs<LaserRecord>(*parser, raw);
  EXPECT_EQ(record.label, "RAWLASER2");
  EXPECT_EQ(record.time, 100.25);
  EXPECT_THAT(record.ranges, ElementsAre(4, 5, 6));
  EXPECT_EQ(record.angles.first, -1.0);
  EXPECT_EQ(record.maxRange, 30.0);
  EXPECT_FALSE(record.odometry);
  expectPose(record.laserPose, -0.25, 0, M_PI);
  record = parseAs<LaserRecord>(*parser, plain);
  EXPECT_EQ(record.label, "LASER3");
  EXPECT_THAT(record.ranges, ElementsAre(1, 2, 3));
  expectPose(record.laserPose, 0, 0, 0);
  EXPECT_THAT(whyBroken(formatNamed("carmen"), "LASER3 3 1 2 100.5 host 7.5"), HasSubstr("fields where"));
  EXPECT_THAT(whyBroken(formatNamed("carmen"), raw + " 1"), HasSubstr("fields where"));

  parser->preview(raw);  // the log does not state the place of LASER3 on the robot
  parseAs<LaserRecord>(*parser, raw);
  EXPECT_EQ(parseAs<OtherRecord>(*parser, plain).name, "LASER3");
  parser->preview(kFlaser);
  EXPECT_EQ(parseAs<OtherRecord>(*parser, raw).name, "RAWLASER2");
  parseAs<LaserRecord>(*parser, kFlaser);
}

TEST(LogParserCarmen, LasersOfWhichNoRowIsUsedAreNamed) {
  const auto ignored = [](const std::vector<std::string>& rows) {
    const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
    for (const std::string& row : rows) parser->preview(row);
    for (const std::string& row : rows) parser->parse(row);
    return parser->ignoredLasers();
  };
  const std::string rear = "R" + kFlaser.substr(1), values = " 3 1 2 3 100.5 host 7.5";
  const std::string third = "laser `LASER3` is not used: the log does not state its pose on the robot";
  EXPECT_THAT(ignored({"LASER1" + values, "LASER2" + values, kFlaser, rear}), testing::IsEmpty());
  EXPECT_THAT(ignored({"LASER3" + values}), testing::IsEmpty());
  EXPECT_THAT(ignored({"LASER3" + values, "LASER1" + values}), ElementsAre(third));
  EXPECT_THAT(
      ignored({"LASER1" + values, "LASER2" + values, "LASER3" + values, kFlaser}),
      ElementsAre("laser `LASER2` is not used: its rows lack the robot's pose, unlike those of other lasers",
                  third));
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

std::string tinyslamRow(int microseconds, int left, int right) {
  std::string row =
      std::to_string(microseconds) + " 14554 " + std::to_string(left) + " " + std::to_string(right);
  for (int i = 4; i < 24; ++i) row += " 7";
  for (int i = 0; i < 683; ++i) row += i == 341 ? " 1500" : " 0";
  return row;
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

TEST(InBackquotes, IsShortAndPrintable) {
  EXPECT_EQ(inBackquotes("abc"), "`abc`");
  EXPECT_EQ(inBackquotes("a\x01\xc3"), "`a??`");
  EXPECT_EQ(inBackquotes(std::string(100, 'x')), "`" + std::string(24, 'x') + "...`");
}

}  // namespace
}  // namespace hybrid_slam::readings
