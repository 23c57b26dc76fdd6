/// Wrong or unusual INI files and logs: one clear error line, or complete results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "HybridSlamProgram.h"
#include "InstalledProgram.h"
#include "files/Trajectory.h"
#include "testing/CompressedBytes.h"
#include "testing/TinyslamRows.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::kResults;
using test::Log;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::UnorderedElementsAreArray;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TEST_F(HybridSlam, WrongIni) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  const auto replayWith = [&](const std::string& text) {
    ini = folder.write("wrong.ini", text);
    return replay(log);
  };
  expectError(replayWith("[particle_filter]\nparticels = 3\n"), "the nearest known key is `particles`");
  expectError(replayWith("[particle_filter]\nparticles = many\n"), "expected a whole number");
  expectError(replayWith("[particle_filter]\nparticles = -1\n"), "0..100000");
  expectError(replayWith("[particle_filter]\nparticles 3\n"), "wrong line");
  expectError(replayWith("[something]\nx = 3\n"), "missing section");
  expectError(replayWith("[particle_filters]\nx = 3\n[grid]\n"), "[particle_filter]");
  expectError(replayWith(""), "missing section");
  expectError(replayWith(std::string("\0\1\2\3", 4)), "not a text file");
  ini = folder.path("none.ini");
  expectError(replay(log), "no such file: " + ini);
  ini = folder.path("");
  expectError(replay(log), "not a file");
}

TEST_F(HybridSlam, WrongStockIni) {
  ini = folder.write("stock.ini", "[MappingApplication]\nsampleSize = 3\n");
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  EXPECT_EQ(replay(log, "-m stock"), 2);
  EXPECT_THAT(err, AllOf(MatchesRegex(kErrorLine), HasSubstr("[MappingApplication]"),
                         HasSubstr("adaptiveSampleSize")));
  EXPECT_THAT(results(), IsEmpty());
}

// ---- logs

TEST_F(HybridSlam, FilesOfKeysAndOptionsMayBeInstalledOnes) {
  const test::InstalledProgram installed(folder, HYBRID_SLAM);
  test::writeGzipped(installed.data("room.rawlog"), test::laps(4));
  std::ofstream(installed.data("no-session")) << "text";
  const auto call = [&](const std::string& arguments) {
    return test::shell(folder, "'" + installed.path + "' -q -o '" + output + "' " + arguments);
  };
  const std::string unknown = folder.write("unknown.ini", "[run]\nrawlog = data/none.rawlog\n");
  test::expectInputError(call(unknown), "hybrid-slam", "no such file: data/none.rawlog;");
  for (const char* option : {"--resume", "--continue", "--localize"})
    test::expectInputError(call(std::string(option) + " data/no-session data/room.rawlog"), "hybrid-slam",
                           installed.data("no-session"));
  test::expectInputError(call("--prior-plan data/no-session data/room.rawlog"), "hybrid-slam",
                         installed.data("no-session"));
  const std::string known = folder.write("known.ini", "[run]\nrawlog = data/room.rawlog\n");
  const test::Outcome outcome = call(known);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
}

TEST_F(HybridSlam, WrongLog) {
  expectError(replay(folder.path("none.rawlog")), "no such file: " + folder.path("none.rawlog"));
  expectError(replay(folder.path("")), "not a file");
  expectError(replay(folder.write("empty", "")), "empty");
  expectError(replay(folder.write("text", "ODOM 1 2 3\nFLASER 4 5 6\n")), "no laser scan");
  expectError(replay(folder.write("text", "no log\n")), "not a robot log");
  expectError(replay(HYBRID_SLAM), "not a log");
  expectError(replay(test::Log{test::odometry(1, {}), test::odometry(2, {})}), "no laser scans");
  expectError(replay(test::Log{test::scan(1), test::scan(2)}, "--set input.require_odometry=true"),
              "require_odometry = false");
  expectError(replay(test::Log{test::odometry(1, {}), test::scan(1, {}, 0)}), "zero length");
  expectError(replay(test::laps(4), "--set input.sensor_label=REAR"), "the log has `LASER`");
  test::Log tilted = test::laps(4);
  for (auto& object : tilted)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      scan->sensorPose.setYawPitchRoll(0, 0.5, 0);
  expectError(replay(tilted), "tilted");
}

TEST_F(HybridSlam, UnreadableLog) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  fs::permissions(log, fs::perms::none);
  if (access(log.c_str(), R_OK) == 0) GTEST_SKIP() << "run as root, who can read everything";
  expectError(replay(log), "cannot open: " + log);
}

/// The room's corners determine the pose; the robot moves by 0.13 m and 4.5 deg per scan.
TEST_F(HybridSlam, ScansAreMatchedWhereThereIsNoOdometry) {
  const auto expectMapped = [&](const std::optional<test::TPose2D>& odometry, const std::string& reason) {
    Log log;
    for (size_t i = 0; i < 60; ++i) {
      const double time = 1000 + 0.2 * static_cast<double>(i);
      if (odometry) log.push_back(test::odometry(time, *odometry));
      log.push_back(test::scan(time, test::poseOnLap(i, 80)));
    }
    expectDone(replay(log, "-p improved"));
    EXPECT_THAT(out, HasSubstr(reason + ": motion is predicted from the previous steps"));
    const auto trajectory = files::loadTum(output + "/trajectory.tum");
    ASSERT_EQ(trajectory.size(), 60u);
    for (size_t i = 0; i < 60; ++i) {
      const auto truth = test::poseOnLap(i, 80) - test::poseOnLap(0, 80);
      EXPECT_LT((trajectory[i].pose - truth).norm(), 0.1) << i;
    }
  };
  expectMapped(std::nullopt, "= false: no odometry");
  expectMapped(test::TPose2D(3, 4, 0.5), "= false: odometry that never changes");
}

TEST_F(HybridSlam, ARobotThatStandsStillStays) {
  expectDone(replay(test::Log{test::scan(1), test::scan(2), test::scan(3)}));
  for (const auto& row : files::loadTum(output + "/trajectory.tum")) EXPECT_LT(row.pose.norm(), 0.2);
}

TEST_F(HybridSlam, ACutLogGivesResultsUpToTheCut) {
  std::vector<size_t> ends;
  const std::string bytes = test::contentOf(test::writePlain(folder.path("whole"), test::laps(40), &ends));
  ASSERT_EQ(replay(folder.write("part", bytes.substr(0, ends[41]))), 0) << err;
  const std::string part = result("trajectory.tum");
  fs::remove_all(output);
  const std::string log = folder.write("cut.rawlog", bytes.substr(0, ends[41] + 33));
  EXPECT_EQ(replay(log), 1);
  EXPECT_THAT(err, MatchesRegex(kErrorLine));
  EXPECT_THAT(err, HasSubstr("cut off in the middle of an object: entry 43 of " + log));
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
  EXPECT_EQ(result("trajectory.tum"), part);
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 21u);
}

TEST_F(HybridSlam, ALogOfTinyslamIsMapped) {
  const std::string log = folder.write("exp.dat", test::tinyslamDrive(30)),
                    rawlog = folder.path("exp.rawlog");
  expectDone(run("'" + log + "' -o '" + output + "'"));
  EXPECT_THAT(out, AllOf(HasSubstr("laser LASER: 682 beams every 0.352 deg"),
                         HasSubstr("grid.max_range = 5.60: the log's limit for the laser")));
  const auto trajectory = files::loadTum(output + "/trajectory.tum");
  ASSERT_EQ(trajectory.size(), 30u);
  for (size_t i = 0; i < 30; ++i) {
    const test::TPose2D truth(test::tinyslamWay(0.2 * static_cast<double>(i)), 0, 0);
    EXPECT_LT((trajectory[i].pose - truth).norm(), 0.1) << i;
  }
  const std::string expected = result("trajectory.tum");
  ASSERT_EQ(test::shell(folder, "'" LOG2RAWLOG "' '" + log + "' '" + rawlog + "'").status, 0);
  expectDone(run("--overwrite '" + rawlog + "' -o '" + output + "'"));
  EXPECT_EQ(result("trajectory.tum"), expected);
}

TEST_F(HybridSlam, ARawlogMayBeCompressedInAnyWay) {
  const std::string plain = test::writePlain(folder.path("plain.rawlog"), test::laps(20));
  expectDone(replay(plain));
  const std::string expected = result("trajectory.tum");
  for (const files::Compression compression : test::kCompressions) {
    SCOPED_TRACE(files::nameOf(compression));
    expectDone(replay(folder.write("packed", test::compressed(compression, contentOf(plain)))));
    EXPECT_EQ(result("trajectory.tum"), expected);
  }
}

TEST_F(HybridSlam, ACutGzippedLogGivesResultsUpToTheCut) {
  const std::string bytes = test::contentOf(test::writeGzipped(folder.path("whole"), test::laps(40)));
  EXPECT_EQ(replay(folder.write("cut.rawlog", bytes.substr(0, bytes.size() / 2))), 1);
  EXPECT_THAT(err, AllOf(MatchesRegex(kErrorLine), HasSubstr("gzip file damaged or cut off: entry ")));
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
  EXPECT_GT(files::loadTum(output + "/trajectory.tum").size(), 5u);
}

/// Laps with some beams of each scan changed.
test::Log withBeams(const std::function<void(test::CObservation2DRangeScan&, size_t)>& change) {
  test::Log log = test::laps(30, 80, 91);
  for (auto& object : log)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      for (size_t i = 3; i < 91; i += 9) change(*scan, i);
  return log;
}

TEST_F(HybridSlam, InvalidReadingsAreIgnoredBeamByBeam) {
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

TEST_F(HybridSlam, AllReadingsInvalid) {
  test::Log log = test::laps(10);
  for (auto& object : log)
    if (const auto scan = std::dynamic_pointer_cast<test::CObservation2DRangeScan>(object))
      for (size_t i = 0; i < 181; ++i) scan->setScanRange(i, kNaN);
  expectDone(replay(log));
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 10u);
}

TEST_F(HybridSlam, ScansWithoutBeamsAreSkipped) {
  test::Log log = test::laps(10);
  log[3] = test::scan(1000.2, {}, 0);
  expectDone(replay(log), "1 scan without beams (or aperture or sensor pose): first at entry 4 of " +
                              folder.path("log.rawlog"));
  EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 9u);
}

TEST_F(HybridSlam, AnyNumberOfBeams) {
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
TEST_F(HybridSlam, OneLongStepDuringAGap) {
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

TEST_F(HybridSlam, AnotherNumberOfBeamsInMidLog) {
  test::Log log = test::laps(40);
  for (size_t i = 20; i < 40; ++i)
    log[2 * i + 1] = test::scan(1000 + 0.2 * static_cast<double>(i), test::poseOnLap(i, 80), 361);
  for (const std::string method : {"hybrid", "general", "linemap", "ortho", "stock"}) {
    SCOPED_TRACE(method);
    expectDone(replay(log, "-m " + method));
    const files::Trajectory trajectory = files::loadTum(output + "/trajectory.tum");
    ASSERT_EQ(trajectory.size(), 40u);
    const auto truth = test::poseOnLap(39, 80) - test::poseOnLap(0, 80);
    EXPECT_LT((trajectory.back().pose - truth).norm(), method == "stock" ? 1 : 0.3);
  }
}

/// A log of 10 scans whose odometry jumps by `jump` m before the last five.
test::Log withJump(double jump) {
  test::Log log = test::laps(10);
  for (size_t i = 10; i < 20; i += 2)
    std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(log[i])->odometry.x_incr(jump);
  return log;
}

TEST_F(HybridSlam, OdometryThatJumps) {
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

TEST_F(HybridSlam, ImpossibleOdometryIsSkipped) {
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
TEST_F(HybridSlam, AScanThatCannotBeTrueIsSkipped) {
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
TEST_F(HybridSlam, OneReadingOfAnyContentEndsNoRun) {
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

TEST_F(HybridSlam, AnActionThatJumpsIsNoMotion) {
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

TEST_F(HybridSlam, TimestampsMissingEqualOrBackwards) {
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
