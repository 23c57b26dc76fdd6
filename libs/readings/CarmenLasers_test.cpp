/// Lasers of CARMEN's logs: where they are on the robot, and which are used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "testing/LogRows.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;
using test::expectPose;
using test::kFlaser;
using test::parseAs;
using test::threeBeamOptions;
using test::whyBroken;
using testing::ElementsAre;
using testing::HasSubstr;

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

/// A row of three beams with two poses.
std::string posedRow(const std::string& name, const TPose2D& laser, const TPose2D& robot) {
  const auto text = [](const TPose2D& p) {
    return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.phi);
  };
  const std::string poses = text(laser) + " " + text(robot);
  return name == "ROBOTLASER1"
             ? "ROBOTLASER1 0 -1.0 2.0 0.5 30.0 0.01 0 3 4 5 6 0 " + poses + " 0 0 1 1 1 5 host 1"
             : name + " 3 1 2 3 " + poses + " 5 host 1";
}

/// The robot's poses as it drives along a curve.
std::vector<TPose2D> drive() {
  std::vector<TPose2D> poses{{1, 2, 0.5}};
  while (poses.size() < 40) poses.push_back(poses.back() + TPose2D(0.2, 0, 0.03));
  return poses;
}

TEST(LogParserCarmen, MostRowsTellTheMounting) {
  const TPose2D mounting(0.4, 0.1, 0.2), odd(1.4, 0, 0);
  for (const std::string name : {"FLASER", "RLASER", "ROBOTLASER1"}) {
    const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
    parser->parse("PARAM robot_rearlaser_offset -0.4 nohost 0");
    std::vector<std::string> rows;
    for (const TPose2D& robot : drive())
      rows.push_back(posedRow(name, robot + (rows.size() == 3 ? odd : mounting), robot));
    for (const std::string& row : rows) parser->preview(row);
    for (const std::string& row : rows) {
      const TPose2D pose = parseAs<LaserRecord>(*parser, row).laserPose;
      EXPECT_NEAR(pose.x, 0.4, 1e-5);
      EXPECT_NEAR(pose.y, 0.1, 1e-5);
      EXPECT_NEAR(std::remainder(pose.phi - (name == "RLASER" ? M_PI : 0.2), 2 * M_PI), 0, 1e-5);
    }
  }
}

TEST(LogParserCarmen, APathCorrectedByAMapperIsNoMounting) {
  for (const std::string name : {"FLASER", "RLASER", "ROBOTLASER1"}) {
    const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
    parser->parse("PARAM robot_frontlaser_offset 0.4 nohost 0");
    parser->parse("PARAM robot_rearlaser_offset -0.3 nohost 0");
    std::vector<std::string> rows;
    for (const TPose2D& robot : drive())  // it began 0.5 m off and drifts
      rows.push_back(posedRow(name, TPose2D(0.5, 0, 0.02 * static_cast<double>(rows.size())) + robot, robot));
    for (const std::string& row : rows) parser->preview(row);
    for (const std::string& row : rows) {
      const TPose2D pose = parseAs<LaserRecord>(*parser, row).laserPose;
      expectPose(pose, name == "RLASER" ? -0.3 : 0.4, 0, name == "RLASER" ? M_PI : 0);
    }
  }
}

TEST(LogParserCarmen, ZerosInPlaceOfThePosesAreNoOdometry) {
  const std::string zeros = posedRow("FLASER", {}, {}), moved = posedRow("FLASER", {1, 0, 0}, {1, 0, 0});
  const auto hasOdometry = [&](size_t scans, const std::string& robot, bool moves) {
    const auto parser = formatNamed("carmen")->makeParser(threeBeamOptions());
    for (size_t i = 0; i < scans; ++i) parser->preview(zeros);
    parser->preview("ODOM " + robot + " 0 0 0 5 host 1");
    if (moves) parser->preview(moved);
    return parseAs<LaserRecord>(*parser, zeros).odometry.has_value();
  };
  EXPECT_FALSE(hasOdometry(10, "1 2 0.5", false));
  EXPECT_TRUE(hasOdometry(9, "1 2 0.5", false)) << "few rows";
  EXPECT_TRUE(hasOdometry(10, "1 2 0.5", true));
  EXPECT_TRUE(hasOdometry(10, "0 0 0", false)) << "it stands";
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

}  // namespace
}  // namespace hybrid_slam::readings
