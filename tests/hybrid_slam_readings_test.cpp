/// Logs with unusual or impossible readings: complete results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "HybridSlamProgram.h"
#include "base/Degree.h"
#include "base/RandomStream.h"
#include "files/Trajectory.h"

namespace hybrid_slam {
namespace {

using testing::HasSubstr;

struct HybridSlamReadings : HybridSlam {};

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Laps with some beams of each scan changed.
test::Log withBeams(const std::function<void(test::CObservation2DRangeScan&, size_t)>& change) {
  test::Log log = test::laps(30, 80, 91);
  for (auto& object : log)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      for (size_t i = 3; i < 91; i += 9) change(*scan, i);
  return log;
}

TEST_F(HybridSlamReadings, InvalidReadingsAreIgnoredBeamByBeam) {
  const test::Log marked = withBeams([](auto& scan, size_t i) { scan.setScanRangeValidity(i, false); });
  const float odd[] = {kNaN, HUGE_VALF, -HUGE_VALF, -3, 0, 20, 81.83f, 1e30f};
  const test::Log unmarked =
      withBeams([&odd](auto& scan, size_t i) { scan.setScanRange(i, odd[i / 9 % 8]); });
  for (const std::string method : {"hybrid", "general", "linemap", "ortho", "stock"}) {
    SCOPED_TRACE(method);
    expectDone(replay(marked, "-m " + method));
    const std::string expected = result("trajectory.tum");
    expectDone(replay(unmarked, "-m " + method));
    EXPECT_EQ(result("trajectory.tum"), expected);
  }
}

TEST_F(HybridSlamReadings, TheOdometryMayHaveAnotherClock) {
  const auto turning = [](double late) {
    RandomStream random(1, 0, 0);
    test::Log log;
    test::TPose2D pose;
    double turn = 0;
    for (int i = 0; i < 300; ++i) {
      const double time = 1000 + 0.2 * i;
      if (i % 10 == 0) turn = 6 * kDegree * (2 * random.uniform() - 1);
      pose = {std::sin(0.5 * time), 0.5 * std::cos(0.5 * time), pose.phi + turn};
      log.push_back(test::odometry(time + late, pose));
      log.push_back(test::scan(time, pose));
      log.push_back(test::scan(time + 0.05, pose, 91, "SECOND"));
    }
    return log;
  };
  expectDone(replay(turning(0)));
  const auto right = files::loadTum(output + "/trajectory.tum");
  EXPECT_THAT(result("config.ini"), HasSubstr("odometry_time_offset = 0\n"));
  expectDone(replay(turning(1)));
  EXPECT_THAT(result("config.ini"), HasSubstr("odometry_time_offset = -1\n"));
  const auto found = files::loadTum(output + "/trajectory.tum");
  ASSERT_EQ(found.size(), right.size());
  for (size_t i = 0; i < found.size(); ++i)
    EXPECT_LT((found[i].pose - right[i].pose).norm(), 0.05) << "reading " << i;
}

TEST_F(HybridSlamReadings, AllReadingsInvalid) {
  test::Log log = test::laps(10);
  for (auto& object : log)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      for (size_t i = 0; i < 181; ++i) scan->setScanRange(i, kNaN);
  expectDone(replay(log), "only 0 of 1810 ranges are above 0 and below the laser's maximum");
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 10u);
}

TEST_F(HybridSlamReadings, ScansWithoutBeamsAreSkipped) {
  test::Log log = test::laps(10);
  log[3] = test::scan(1000.2, {}, 0);
  expectDone(replay(log), "1 scan without beams (or aperture or sensor pose): first at entry 4 of " +
                              folder.path("log.rawlog"));
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 9u);
}

TEST_F(HybridSlamReadings, AnyNumberOfBeams) {
  for (const size_t beams : {1u, 2u, 3u, 5000u}) {
    SCOPED_TRACE(beams);
    expectDone(replay(test::laps(10, 80, beams)));
    for (const std::string method : {"likelihood_field", "ray_tracing", "consensus"})
      expectDone(replay(test::laps(10, 80, beams), "--set grid_weight.method=" + method));
  }
  test::Log log = test::laps(10);
  log[5] = test::scan(1000.4, test::poseOnLap(2, 80), 1);
  expectDone(replay(log, "-m stock"));
}

/// MRPT gives no weight to an action this uncertain.
TEST_F(HybridSlamReadings, OneLongStepDuringAGap) {
  test::Log log = test::laps(20);
  for (size_t i = 10; i < 20; ++i) {
    const mrpt::math::TPose2D pose = test::poseOnLap(i, 80);
    log[2 * i] = test::odometry(1105 + 0.2 * static_cast<double>(i), mrpt::math::TPose2D(90, 0, 0) + pose);
    log[2 * i + 1] = test::scan(1105 + 0.2 * static_cast<double>(i), pose);
  }
  for (const std::string options : {"", "-m stock", "--set particle_filter.proposal=auxiliary_standard",
                                    "--set particle_filter.proposal=auxiliary_optimal"}) {
    SCOPED_TRACE(options);
    expectDone(replay(log, "-n 5 --set loop_closing.enabled=false " + options));
    const auto poses = files::loadTum(output + "/trajectory.tum");
    ASSERT_EQ(poses.size(), 20u);
    EXPECT_GT(poses.back().pose.norm(), 50);
    const nlohmann::json metrics = nlohmann::json::parse(result("metrics.json"));
    const std::string steps = result("steps.csv");
    EXPECT_EQ(metrics["updates"], std::count(steps.begin(), steps.end(), '\n') - 1);
  }
}

TEST_F(HybridSlamReadings, AnotherNumberOfBeamsInMidLog) {
  test::Log log = test::laps(40);
  for (size_t i = 20; i < 40; ++i)
    log[2 * i + 1] = test::scan(1000 + 0.2 * static_cast<double>(i), test::poseOnLap(i, 80), 361);
  for (const std::string method : {"hybrid", "general", "linemap", "ortho", "stock"}) {
    SCOPED_TRACE(method);
    expectDone(replay(log, "-n 20 -m " + method));
    const files::Trajectory trajectory = files::loadTum(output + "/trajectory.tum");
    ASSERT_EQ(trajectory.size(), 40u);
    const auto truth = test::poseOnLap(39, 80) - test::poseOnLap(0, 80);
    EXPECT_LT((trajectory.back().pose - truth).norm(), method == "stock" ? 1 : 0.1);
  }
}

/// A log of 10 scans whose odometry jumps by `jump` m before the last five.
test::Log withJump(double jump) {
  test::Log log = test::laps(10);
  for (size_t i = 10; i < 20; i += 2)
    std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(log[i])->odometry.x_incr(jump);
  return log;
}

TEST_F(HybridSlamReadings, OdometryThatJumps) {
  for (const double jump : {60., 101., 1e5, 1e7}) {
    SCOPED_TRACE(jump);
    expectDone(replay(withJump(jump)),
               "1 odometry jump of over 100 m or far above the robot's speed: first at entry 11 of " +
                   folder.path("log.rawlog"));
    const auto poses = files::loadTum(output + "/trajectory.tum");
    ASSERT_EQ(poses.size(), 10u);
    EXPECT_LT(poses.back().pose.norm(), 10);
    EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["skipped_readings"], 1);
  }
}

TEST_F(HybridSlamReadings, OdometryThatJumpsAllTheTimeLeavesTheMapInDoubt) {
  test::Log log;
  for (int i = 0; i < 40; ++i) {
    log.push_back(test::odometry(1000 + i, {i % 2 * 1e4, 0, 0}));
    log.push_back(test::scan(1000 + i));
  }
  EXPECT_EQ(replay(log), 0);
  EXPECT_THAT(out, HasSubstr("verdict: doubtful: 39 odometry readings are impossible or jump, in 40 scans"));
}

TEST_F(HybridSlamReadings, ImpossibleOdometryIsSkipped) {
  for (const double jump : {1e9, 1e30, 1e300}) {
    SCOPED_TRACE(jump);
    EXPECT_EQ(replay(withJump(jump)), 0);
    EXPECT_THAT(err,
                HasSubstr("5 impossible odometry readings: not a number, or beyond 1e8 m or 1e6 rad: first "
                          "at entry 11 of " +
                          folder.path("log.rawlog") + "; skipped\n"));
    EXPECT_THAT(err, HasSubstr("scan matching replaced it"));
    const auto poses = files::loadTum(output + "/trajectory.tum");
    ASSERT_EQ(poses.size(), 10u);
    EXPECT_LT(poses.back().pose.norm(), 10);
    EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["skipped_readings"], 5);
  }
  test::Log log = test::laps(10);
  for (size_t i = 0; i < 20; i += 2)
    std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(log[i])->odometry = {1e30, 0, 0};
  expectDone(replay(log), "10 impossible odometry readings");
  EXPECT_THAT(out, HasSubstr("no odometry: motion is predicted from the previous steps"));
}

/// One of 40 scans is impossible.
TEST_F(HybridSlamReadings, AScanThatCannotBeTrueIsSkipped) {
  const auto with = [](const mrpt::poses::CPose3D& sensor) {
    test::Log log = test::laps(40);
    std::dynamic_pointer_cast<test::CObservation2DRangeScan>(log[21])->sensorPose = sensor;
    return log;
  };
  for (const double far : {101., 3270., 1e5, 1e300}) {
    SCOPED_TRACE(far);
    expectDone(replay(with({far, far, 0, 0, 0, 0})),
               "1 scan with a sensor pose over 100 m from the robot: first at entry 22 of");
    EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["skipped_readings"], 1);
    EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 39u);
  }
  for (const std::string options : {"", "--set input.sensor_label=LASER"})
    expectDone(replay(with({0, 0, 0, 0, 0.5, 0}), options),
               "1 scan of a tilted plane: first at entry 22 of " + folder.path("log.rawlog"));
  EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["complete"], true);
}

/// One reading of any content prevents neither results nor bounded memory.
TEST_F(HybridSlamReadings, OneReadingOfAnyContentEndsNoRun) {
  using Scan = test::CObservation2DRangeScan;
  const std::vector<std::function<void(Scan&, mrpt::obs::CObservationOdometry&)>> changes{
      [](Scan& scan, auto&) { scan.aperture = 1e30f; },
      [](Scan& scan, auto&) { scan.aperture = -1; },
      [](Scan& scan, auto&) { scan.maxRange = 1e30f, scan.setScanRange(5, 1e29f); },
      [](Scan& scan, auto&) { scan.maxRange = kNaN, scan.setScanRange(5, 1e29f); },
      [](Scan& scan, auto&) { scan.sensorPose.z(1e300); },
      [](Scan& scan, auto&) { scan.sensorPose.setYawPitchRoll(1e300, 0, 0); },
      [](Scan& scan, auto&) { scan.sensorPose.setYawPitchRoll(0, kNaN, 0); },
      [](Scan& scan, auto&) { scan.timestamp = mrpt::Clock::fromDouble(9e9); },
      [](Scan& scan, auto&) { scan.resizeScan(200000); },
      [](auto&, auto& odometry) { odometry.odometry.phi(1e300); },
      [](auto&, auto& odometry) { odometry.odometry.x(-1e300); },
      [](auto&, auto& odometry) { odometry.odometry.y(kNaN); },
      [](auto&, auto& odometry) { odometry.timestamp = mrpt::Clock::fromDouble(9e9); }};
  for (size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(i);
    test::Log log = test::laps(20);
    changes[i](dynamic_cast<Scan&>(*log[21]), dynamic_cast<mrpt::obs::CObservationOdometry&>(*log[20]));
    EXPECT_EQ(replay(log), 0) << err;
    EXPECT_GE(files::loadTum(output + "/trajectory.tum").size(), 19u);
    EXPECT_LT(nlohmann::json::parse(result("metrics.json"))["peak_rss_mb"], 400);
  }
}

TEST_F(HybridSlamReadings, AnActionThatJumpsIsNoMotion) {
  test::Log log;
  for (size_t i = 0; i < 10; ++i) {
    log.push_back(test::action({0.1, 0, 0}));
    log.push_back(test::frame({test::scan(1000 + 0.2 * static_cast<double>(i), {})}));
  }
  log[4] = test::action({99, 0, 0});
  expectDone(replay(log));
  expectDone(replay(log, "--set particle_filter.update_distance=100"));
  log[4] = test::action({1e30, 0, 0});
  expectDone(replay(log), "1 odometry jump of over 100 m or far above the robot's speed: first at entry 5");
}

TEST_F(HybridSlamReadings, TimestampsMissingEqualOrBackwards) {
  const auto timesOf = [this] {
    std::vector<double> times;
    for (const auto& row : files::loadTum(output + "/trajectory.tum")) times.push_back(row.timestamp - 1000);
    return times;
  };
  const auto withTimes = [](const std::vector<double>& times) {
    test::Log log;
    for (size_t i = 0; i < times.size(); ++i) {
      const double time = 1000 + times[i];
      log.push_back(test::odometry(time, test::poseOnLap(i, 40)));
      log.push_back(test::scan(time, test::poseOnLap(i, 40)));
    }
    return log;
  };
  expectDone(replay(withTimes({0, 1, test::kNoTime, 3})), "1 scan without timestamp: first at entry 6");
  EXPECT_THAT(timesOf(), testing::ElementsAre(0, 1, 1, 3));
  expectDone(replay(withTimes({0, 1, 1, 3})),
             "1 timestamp equal to that of the previous scan: first at entry 6");
  EXPECT_THAT(timesOf(), testing::ElementsAre(0, 1, 1, 3));
  expectDone(replay(withTimes({0, 2, 1, 3})), "1 step back of the timestamps: first at entry 6");
  EXPECT_THAT(timesOf(), testing::ElementsAre(0, 2, 1, 3));
  expectDone(replay(withTimes(std::vector<double>(4, test::kNoTime))),
             "4 scans without timestamp: first at entry 2");
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 4u);
  expectDone(replay(withTimes({0, 1, 9e4, 90001})),
             "1 timestamp over a day after that of the previous scan: first at entry 6");
}

}  // namespace
}  // namespace hybrid_slam
