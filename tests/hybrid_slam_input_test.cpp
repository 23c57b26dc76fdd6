/// Wrong or unusual INI files and logs: one clear error line, or complete results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
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

struct HybridSlamInput : HybridSlam {};
using HybridSlamInputAsUser = HybridSlamInput;  // skipped as root, apart from the others

TEST_F(HybridSlamInput, WrongIni) {
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

TEST_F(HybridSlamInput, WrongStockIni) {
  ini = folder.write("stock.ini", "[MappingApplication]\nsampleSize = 3\n");
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  EXPECT_EQ(replay(log, "-m stock"), 2);
  EXPECT_THAT(err, AllOf(MatchesRegex(kErrorLine), HasSubstr("[MappingApplication]"),
                         HasSubstr("adaptiveSampleSize")));
  EXPECT_THAT(results(), IsEmpty());
}

// ---- logs

TEST_F(HybridSlamInput, FilesOfKeysAndOptionsMayBeInstalledOnes) {
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

TEST_F(HybridSlamInput, WrongLog) {
  expectError(replay(folder.path("none.rawlog")), "no such file: " + folder.path("none.rawlog"));
  expectError(replay(folder.path("")), "not a file");
  expectError(replay(folder.write("empty", "")), "empty");
  expectError(replay(folder.write("text", "ODOM 1 2 3\nFLASER 4 5 6\n")), "text, first broken line 1 (");
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

TEST_F(HybridSlamInputAsUser, UnreadableLog) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  fs::permissions(log, fs::perms::none);
  if (access(log.c_str(), R_OK) == 0) GTEST_SKIP() << "run as root, who can read everything";
  expectError(replay(log), "cannot open: " + log);
}

/// The room's corners determine the pose; the robot moves by 0.13 m and 4.5 deg per scan.
TEST_F(HybridSlamInput, ScansAreMatchedWhereThereIsNoOdometry) {
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

TEST_F(HybridSlamInput, ARobotThatStandsStillStays) {
  expectDone(replay(test::Log{test::scan(1), test::scan(2), test::scan(3)}));
  const files::Trajectory trajectory = files::loadTum(output + "/trajectory.tum");
  EXPECT_EQ(trajectory.size(), 3u);
  for (const auto& row : trajectory) EXPECT_LT(row.pose.norm(), 0.2);
}

TEST_F(HybridSlamInput, ACutLogGivesResultsUpToTheCut) {
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

TEST_F(HybridSlamInput, ALogOfTinyslamIsMapped) {
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

TEST_F(HybridSlamInput, ARawlogMayBeCompressedInAnyWay) {
  const std::string plain = test::writePlain(folder.path("plain.rawlog"), test::laps(20));
  expectDone(replay(plain));
  const std::string expected = result("trajectory.tum");
  for (const files::Compression compression : test::kCompressions) {
    SCOPED_TRACE(files::nameOf(compression));
    expectDone(replay(folder.write("packed", test::compressed(compression, contentOf(plain)))));
    EXPECT_EQ(result("trajectory.tum"), expected);
  }
}

TEST_F(HybridSlamInput, ACutGzippedLogGivesResultsUpToTheCut) {
  const std::string bytes = test::contentOf(test::writeGzipped(folder.path("whole"), test::laps(40)));
  EXPECT_EQ(replay(folder.write("cut.rawlog", bytes.substr(0, bytes.size() / 2))), 1);
  EXPECT_THAT(err, AllOf(MatchesRegex(kErrorLine), HasSubstr("gzip file damaged or cut off: entry ")));
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
  EXPECT_GT(files::loadTum(output + "/trajectory.tum").size(), 5u);
}

}  // namespace
}  // namespace hybrid_slam
