#include "run/LogSettings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <functional>

#include "base/Degree.h"
#include "files/TemporaryFolder.h"
#include "testing/RingDrive.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;
using test::CObservation2DRangeScan;
using testing::ElementsAre;
using testing::HasSubstr;

/// A log of laps with each scan changed.
class LogSettingsTest : public testing::Test {
 protected:
  using Change = std::function<void(CObservation2DRangeScan&)>;

  LogSettings read(const Change& change, size_t beams = 181, size_t stepsPerLap = 80) {
    const test::Log log = test::laps(20, stepsPerLap, beams);
    for (const auto& object : log)
      if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) change(*scan);
    const std::string file = test::writeGzipped(folder.path("log.rawlog"), log);
    return readLogSettings(file, input, readings::summarise(file, input));
  }
  std::string valueOf(const std::string& key, const Change& change, size_t stepsPerLap = 80) {
    for (const LogSetting& setting : read(change, 181, stepsPerLap).settings)
      if (setting.section + "." + setting.key == key) return setting.value;
    return "none";
  }
  files::TemporaryFolder folder;
  readings::InputOptions input;
};

/// Simulates a laser with this limit (m) in a room `scale` times as large; farther walls give no return, or
/// `code` (m).
auto laser(double limit, double scale = 1, double code = 0) {
  return [=](CObservation2DRangeScan& scan) {
    scan.maxRange = static_cast<float>(code > 0 ? 80 : limit);
    for (size_t i = 0; i < scan.getScanSize(); ++i) {
      const double range = scale * static_cast<double>(scan.getScanRange(i));
      scan.setScanRange(i, static_cast<float>(range < limit ? range : code));
      scan.setScanRangeValidity(i, range < limit || code > 0);
    }
  };
}

void asItIs(CObservation2DRangeScan&) {}

TEST_F(LogSettingsTest, MaximumRange) {
  const auto maxRange = [this](const Change& change) { return valueOf("grid.max_range", change); };
  EXPECT_EQ(maxRange(laser(80)), "20") << "a building";
  EXPECT_EQ(maxRange(laser(80, 6)), "50") << "a hall of 60 m by 36 m";
  EXPECT_EQ(maxRange(laser(200, 15)), "80") << "150 m by 90 m";
  EXPECT_EQ(maxRange(laser(8)), "8") << "no farther than the laser";
  EXPECT_EQ(maxRange(laser(5.6, 2)), "5.60");
  EXPECT_EQ(maxRange(laser(8, 1.7, 8.191)), "8.17") << "what a SICK laser in 8 m mode logs for no return";
  EXPECT_EQ(maxRange(laser(30, 6, 30)), "29.94");
  EXPECT_EQ(maxRange([](auto& scan) {
              for (size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRange(i, 3);
            }),
            "20")
      << "a round room is no code";
  EXPECT_EQ(maxRange([](auto& scan) {
              for (size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRangeValidity(i, false);
            }),
            "20")
      << "no returns";
}

TEST_F(LogSettingsTest, SparsePointsNeedLargerCells) {
  const auto cell = [this](const Change& change) { return valueOf("grid.resolution", change); };
  EXPECT_EQ(cell(asItIs), "none") << "0.05 m apart";
  EXPECT_EQ(cell(laser(80, 6)), "0.1") << "a hall of 60 m by 36 m";
  const auto everyFourthBeam = [](CObservation2DRangeScan& scan) {
    for (size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRangeValidity(i, i % 4 == 0);
  };
  EXPECT_EQ(cell(everyFourthBeam), "0.1");
  EXPECT_EQ(cell(laser(3.5, 1, 81)), "none") << "most beams have no return";
  EXPECT_EQ(cell([](auto& scan) { scan.setScanRangeValidity(0, false); }), "none");
  EXPECT_EQ(cell([](auto& scan) {
              for (size_t i = 1; i < scan.getScanSize(); ++i) scan.setScanRangeValidity(i, false);
            }),
            "none")
      << "a single return has no neighbour";
}

TEST_F(LogSettingsTest, AnEarlierMapHasItsOwnCells) {
  const LogSettings log = read(laser(80, 6));
  Configuration alone("", {}), continued("", {}), localized("", {});
  continued.run.continueFrom = localized.run.localizeIn = "map.yaml";
  for (Configuration* c : {&alone, &continued, &localized}) {
    applyLogSettings(log, *c);
    EXPECT_EQ(c->filter.grid.resolution, c == &alone ? 0.1 : 0.05);
  }
}

TEST_F(LogSettingsTest, NoiseOfDirections) {
  const auto inStepsOf = [](double step) {
    return [step](CObservation2DRangeScan& scan) {
      for (size_t i = 0; i < scan.getScanSize(); ++i)
        scan.setScanRange(i, static_cast<float>(step * std::round(scan.getScanRange(i) / step)));
    };
  };
  EXPECT_EQ(valueOf("line_weight.sigma_deg", inStepsOf(0.01)), "0.5");
  EXPECT_EQ(valueOf("line_weight.sigma_deg", inStepsOf(0.05)), "0.5");
  EXPECT_EQ(valueOf("line_weight.sigma_deg", inStepsOf(0.001)), "0.4");
  EXPECT_EQ(valueOf("line_weight.sigma_deg", asItIs), "0.4");
  input.scanTime = 0.1;  // the correction for the motion changes the ranges
  EXPECT_EQ(valueOf("line_weight.sigma_deg", inStepsOf(0.01)), "0.5");
  input.scanTime.reset(), input.scanRate = 5;
  EXPECT_EQ(valueOf("line_weight.sigma_deg", inStepsOf(0.01)), "0.5");
}

TEST_F(LogSettingsTest, SparseScansAreAllUsed) {
  EXPECT_EQ(valueOf("improved_proposal.update_distance", asItIs), "0.1") << "0.12 m apart";
  EXPECT_EQ(valueOf("improved_proposal.update_angle_deg", asItIs), "5");
  EXPECT_EQ(valueOf("improved_proposal.update_distance", asItIs, 10), "0.02") << "1 m apart";
  EXPECT_EQ(valueOf("improved_proposal.update_angle_deg", asItIs, 10), "1");
}

TEST_F(LogSettingsTest, OdometryThatNeverChangesIsNoOdometry) {
  std::vector<std::string> lines;
  const auto usesOdometry = [&](const std::function<test::TPose2D(size_t)>& odometry) {
    test::Log log;
    for (size_t i = 0; i < 4; ++i) {
      log.push_back(test::odometry(1. + static_cast<double>(i), odometry(i)));
      log.push_back(test::scan(1. + static_cast<double>(i)));
    }
    const std::string file = test::writeGzipped(folder.path("log.rawlog"), log);
    Configuration c("", {});
    lines = applyLogSettings(readLogSettings(file, {}, readings::summarise(file, {})), c);
    return c.input.requireOdometry;
  };
  EXPECT_FALSE(usesOdometry([](size_t) { return test::TPose2D(1, 2, 3); }));
  EXPECT_EQ(lines.back(),
            "input.require_odometry = false: odometry that never changes: motion is predicted from the "
            "previous steps");
  EXPECT_TRUE(usesOdometry([](size_t i) { return test::TPose2D(i == 3 ? 0.01 : 0, 0, 0); }));
  EXPECT_TRUE(usesOdometry([](size_t i) { return test::TPose2D(1, 2, i == 3 ? 0.01 : 0); }));
  EXPECT_EQ(lines.back(),
            "input.heading_odometry = true: the odometry's position never changes: scan matching gives it");
}

TEST_F(LogSettingsTest, ALaserWithoutAPlaceOnTheRobotMayBeTurned) {
  const auto pose = [this](double yaw, double x) {
    const std::string file = folder.path("drive.rawlog");
    RandomStream random(1, 0, 0);
    test::Log log;
    TPose2D odometry;
    for (const test::DrivenPose& at : test::driveAlong(test::ring(), {{0, 0}, {31.5, 0}, {31.5, 21}}, 0)) {
      const double time = 0.5 * static_cast<double>(log.size());
      const LaserScan seen =
          test::scanOf(test::ring(), at.truth, {x, 0, yaw * kDegree}, 181, M_PI, 0.01, random);
      const auto scan = test::observed(seen)[0];
      scan->sensorPose = mrpt::poses::CPose3D(x, 0, 0, 0, 0, 0);
      scan->timestamp = test::stamp(time);
      odometry = odometry + at.motion;
      log.push_back(test::odometry(time, odometry));
      log.push_back(scan);
    }
    test::writeGzipped(file, log);
    for (const LogSetting& setting : readLogSettings(file, input, readings::summarise(file, input)).settings)
      if (setting.key == "laser_pose") return setting.value;
    return std::string("none");
  };
  EXPECT_EQ(pose(90, 0), "0, 0, 90");
  EXPECT_EQ(pose(0, 0), "none");
  EXPECT_EQ(pose(90, 0.2), "none") << "the log states where it is";
}

TEST_F(LogSettingsTest, TheOdometryMayHaveAnotherClock) {
  const auto offset = [this](double late) {
    RandomStream random(1, 0, 0);
    test::Log log;
    TPose2D pose;
    double turn = 0;
    for (int i = 0; i < 400; ++i) {
      const double time = 1000 + 0.2 * i;
      if (i % 10 == 0) turn = 6 * kDegree * (2 * random.uniform() - 1);
      pose.phi += turn;
      log.push_back(test::odometry(time + late, pose));
      log.push_back(test::scan(time, pose));
    }
    const std::string file = test::writeGzipped(folder.path("log.rawlog"), log);
    for (const LogSetting& setting : readLogSettings(file, input, readings::summarise(file, input)).settings)
      if (setting.key == "odometry_time_offset") return setting.value + ": " + setting.reason;
    return std::string("none");
  };
  EXPECT_EQ(offset(1), "-1.00: the odometry turns later than the scans");
  EXPECT_EQ(offset(-0.6), "0.60: the odometry turns earlier than the scans");
  EXPECT_EQ(offset(0.2), "none") << "the filter copes with it";
}

TEST_F(LogSettingsTest, TheMountingOfASecondLaserIsWithoutTheRobotsMotion) {
  test::Log log;
  for (int i = 0; i < 20; ++i) {
    const double x = 0.1 * i;
    log.push_back(test::odometry(1 + 0.1 * i, {x, 0, 0}));
    log.push_back(test::scan(1.01 + 0.1 * i, {x, 0, 0}, 181, "A"));
    log.push_back(test::scan(1.06 + 0.1 * i, {x, 0, 0}, 181, "B"));
  }
  const std::string file = test::writeGzipped(folder.path("log.rawlog"), log);
  EXPECT_THAT(readLogSettings(file, input, readings::summarise(file, input)).lasers,
              ElementsAre(HasSubstr("laser A: 181 beams every 1 deg, at x 0.00 m"),
                          HasSubstr("laser B: 181 beams every 1 deg, at x 0.00 m")));
}

TEST_F(LogSettingsTest, DescribesTheLaser) {
  EXPECT_THAT(read(asItIs, 180).lasers,
              ElementsAre(HasSubstr("laser LASER: 180 beams every 1.006 deg, at x 0.00 m")));
  EXPECT_THAT(read(asItIs, 361).lasers, ElementsAre(HasSubstr("361 beams every 0.5 deg")));
  EXPECT_THAT(read(asItIs, 541).lasers, ElementsAre(HasSubstr("541 beams every 0.333 deg")));
  EXPECT_THAT(read(asItIs, 1).lasers, ElementsAre(HasSubstr("1 beams, at")));
  const auto moved = read([](auto& scan) { scan.sensorPose = mrpt::poses::CPose3D(0.4, -0.1, 0, M_PI / 2); });
  EXPECT_THAT(moved.lasers, ElementsAre(HasSubstr("at x 0.40 m, y -0.10 m, 90 deg on the robot")));
}

/// Only the first 2,000 readings are searched for the settings.
TEST_F(LogSettingsTest, NamesALaserThatStartsLater) {
  test::Log log = test::laps(2001, 80, 3);
  for (const char* label : {"FRONT", "REAR"}) log.push_back(test::scan(1400.2, {}, 3, label));
  const std::string file = test::writeGzipped(folder.path("log.rawlog"), log);
  const auto lasers = [&] { return readLogSettings(file, input, readings::summarise(file, input)).lasers; };
  EXPECT_THAT(lasers(), ElementsAre("laser FRONT: no scan in the first 2000 readings",
                                    HasSubstr("laser LASER: 3 beams"),
                                    "laser REAR: no scan in the first 2000 readings"));
  input.sensorLabel = "LASER, REAR";
  EXPECT_THAT(lasers(), ElementsAre(HasSubstr("laser LASER: 3 beams"),
                                    "laser REAR: no scan in the first 2000 readings"));
}

TEST_F(LogSettingsTest, TheIniFileAndTheCommandLineAreStronger) {
  const LogSettings log = read(laser(8));
  const std::string ini = folder.write("run.ini", "[grid]\nmax_range = 30\n");
  Configuration c(ini, {"line_weight.sigma_deg=1"});
  EXPECT_THAT(applyLogSettings(log, c), ElementsAre(HasSubstr("laser"), HasSubstr("update_distance = 0.1: "),
                                                    HasSubstr("update_angle_deg = 5: ")));
  EXPECT_EQ(c.filter.grid.maxRange, 30);
  EXPECT_NEAR(c.filter.lineWeight.sigma, mrpt::DEG2RAD(1.0), 1e-12);

  Configuration defaults("", {});
  applyLogSettings(log, defaults);
  EXPECT_EQ(defaults.filter.grid.maxRange, 8);
  EXPECT_THAT(defaults.text(), HasSubstr("max_range = 8"));
}

}  // namespace
}  // namespace hybrid_slam::run
