/// slam-eval nees-relations: the covariance between two poses against relations, by hand, and invalid input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "SlamEvalProgram.h"
#include "base/Numbers.h"
#include "files/Trajectory.h"
#include "testing/TestLogs.h"

namespace hybrid_slam {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kMatch = 2e-4;                                   // m^2, two scan matches
const double kTurn = 2 * std::pow(0.09 * M_PI / 180, 2);          // rad^2, the same
constexpr double kDrift = 0.5 * 16e-6, kOpenDrift = 0.5 * 25e-6;  // m^2, over 0.5 m

/// A run of two scans, 0.5 m apart in the direction of the robot.
struct NeesOfRelations : SlamEval {
  void SetUp() override {
    test::Log log;
    std::string steps = "timestamp,particles\n";
    files::Trajectory trajectory;
    for (int i = 0; i < 2; ++i) {
      const mrpt::math::TPose2D pose(0.5 * i, 0, 0);
      log.push_back(test::odometry(1000 + i, pose));
      log.push_back(test::scan(1000 + i, pose));
      trajectory.push_back({1000.0 + i, pose});
      steps += fixedText(1000 + i, 6) + ",2\n";
    }
    test::writeGzipped(folder.path("log.rawlog"), log);
    write("config.ini", "[run]\nmethod = hybrid\n");
    write("steps.csv", steps);
    write("metrics.json", R"({"path_relaxed": true})");
    std::ofstream text(folder.path("trajectory.tum"));
    files::saveTum(trajectory, text);
  }
  const std::string call = "nees-relations --run . --rawlog log.rawlog --relations relations ";
};

TEST_F(NeesOfRelations, AreInUnitsOfTheVariance) {
  write("relations", "1000 1001 0.55 0 0 0 0 0\n1000 1007 1 0 0 0 0 0\n");
  const json errors = figures(call);
  EXPECT_EQ(errors.size(), 8u);
  EXPECT_EQ(errors.at("relations"), 2);
  EXPECT_EQ(errors.at("used"), 1);
  EXPECT_NEAR(errors.at("nees_mean"), 0.05 * 0.05 / (kMatch + kDrift), 1e-6);
  EXPECT_EQ(errors.at("nees_median"), errors.at("nees_mean"));
  EXPECT_EQ(errors.at("inside_95"), 0);
  EXPECT_EQ(errors.at("inside_95_x"), 0);
  EXPECT_EQ(errors.at("inside_95_y"), 1);
  EXPECT_EQ(errors.at("inside_95_heading"), 1);
  EXPECT_NEAR(figures(call + "--noise 0.05").at("nees_mean"), 0.0025 / (kMatch + kDrift + 0.0025), 1e-6);
  EXPECT_EQ(figures(call + "--noise 0.05").at("inside_95"), 1);
  write("config.ini", "[run]\nmethod = general\n");
  EXPECT_NEAR(figures(call).at("nees_mean"), 0.0025 / (kMatch + kOpenDrift), 1e-6) << "without lines";
}

TEST_F(NeesOfRelations, TheirRotationHasItsOwnNoise) {
  write("relations", "1000 1000 0 0 0 0 0 0.1\n");
  EXPECT_NEAR(figures(call).at("nees_mean"), 0.01 / kTurn, 1e-3);
  const double noise = 3 * M_PI / 180;
  EXPECT_NEAR(figures(call + "--noise-deg 3").at("nees_mean"), 0.01 / (kTurn + noise * noise), 1e-6);
}

TEST_F(NeesOfRelations, OdometryCarriesPosesToTheirTimes) {
  write("relations", "1000 1000.4 0.2 0 0 0 0 0\n");
  write("odometry", "1000 0 0 0\n1000.4 0.25 0 0\n1001 0.5 0 0\n");
  // From one match to the odometry's 0.25 m after the same one.
  EXPECT_NEAR(figures(call + "--odometry odometry").at("nees_mean"), 0.0025 / (kMatch + 0.25 * 4e-4), 1e-6);
}

TEST_F(NeesOfRelations, ALaserThatTheRunIgnoredIsAWarning) {
  write("relations", "1000 1001 0.5 0 0 0 0 0\n");
  write("config.ini", "[run]\nmethod = hybrid\n[input]\nsensor_label = LASER\n");
  test::Log log;
  for (int i = 0; i < 2; ++i) {
    const mrpt::math::TPose2D pose(0.5 * i, 0, 0);
    log.push_back(test::odometry(1000 + i, pose));
    for (const char* label : {"LASER", "REAR"}) log.push_back(test::scan(1000 + i, pose, 181, label));
  }
  test::writeGzipped(folder.path("log.rawlog"), log);
  const test::Outcome outcome = run(call);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "slam-eval: warning: laser `REAR` is not used: not in [input] sensor_label\n");
}

TEST_F(NeesOfRelations, WrongInput) {
  write("relations", "1000 1001 0.5 0 0 0 0 0\n");
  for (const char* option : {"--noise", "--noise-deg"})
    for (const char* value : {"-1", "nan", "inf"})
      EXPECT_EQ(
          errorLine(call + option + "=" + value),
          std::string("slam-eval: error: wrong value: option ") + option + "; expected a number in 0..1e7");
  EXPECT_THAT(errorLine("nees-relations --run none --rawlog log.rawlog --relations relations"),
              HasSubstr("none/config.ini"));
  EXPECT_THAT(errorLine("nees-relations --run . --rawlog none.rawlog --relations relations"),
              HasSubstr("no such file: none.rawlog"));
  write("relations", "5 6 0.5 0 0 0 0 0\n");
  EXPECT_THAT(errorLine(call), HasSubstr("no usable relation: "));
  test::writeGzipped(folder.path("log.rawlog"), test::laps(1));
  EXPECT_THAT(errorLine(call), HasSubstr("the log is not that of the run: log.rawlog; "));
}

}  // namespace
}  // namespace hybrid_slam
