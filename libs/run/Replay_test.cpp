#include "run/Replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "files/TemporaryFolder.h"
#include "run/FilterRun.h"
#include "run/MotionModelText.h"
#include "testing/CommaLocale.h"
#include "testing/DriveLog.h"
#include "testing/ErrorOf.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

/// Waits until a run into the folder `out` has begun.
void waitForARun(const files::TemporaryFolder& folder) {
  const auto hasBegun = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path("")))
      if (entry.path().filename().string().rfind(".out.part-", 0) == 0) return true;
    return false;
  };
  while (!hasBegun()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// The text results, without the step times.
std::map<std::string, std::string> resultsOf(const files::TemporaryFolder& folder, const std::string& ini,
                                             const std::string& log) {
  Configuration c(ini, {"run.rawlog=" + log, "run.output=" + folder.path("out"), "run.particles_every=10",
                        "motion_model.distance_var_d=0.0025"});
  c.run.overwrite = true;
  const std::atomic<bool> stop{false};
  replay(c, true, stop);
  std::map<std::string, std::string> texts;
  for (const char* name : {"trajectory.tum", "map.yaml", "lines.csv", "particles.csv", "config.ini"})
    texts[name] = test::contentOf(folder.path(std::string("out/") + name));
  const std::regex stepTime(",[^,\n]*((,[^,\n]*){6}\n)");
  texts["steps.csv"] = std::regex_replace(test::contentOf(folder.path("out/steps.csv")), stepTime, "$1");
  texts["motion model"] =
      motionModelSection(c.filter.motion, {}) + motionModelTableRow(1, -2.5, c.filter.motion);
  return texts;
}

TEST(Replay, TheResultsAreTheSameInEveryLocale) {
  const files::TemporaryFolder folder;
  const std::string log = test::writeGzipped(folder.path("laps.rawlog"), test::laps(60));
  const std::string ini = folder.write("run.ini",
                                       "[particle_filter]\nparticles = 5\nproposal = "
                                       "standard\nupdate_distance = 0.2\n[grid]\nresolution = 0.1\n");
  const auto expected = resultsOf(folder, ini, log);
  const test::CommaLocale german;
  for (const auto& [name, text] : resultsOf(folder, ini, log)) {
    EXPECT_EQ(text, expected.at(name)) << name;
    EXPECT_GT(text.size(), 50u) << name;
  }
}

/// As a log that its robot overwrites.
TEST(Replay, ALogThatIsCutWhileItIsReadGivesItsBeginningAndAMessage) {
  const files::TemporaryFolder folder;
  std::string rows;
  for (int i = 0; i < 4000; ++i) {
    rows += "FLASER 181";
    for (int beam = 0; beam < 181; ++beam) rows += " 2.5";
    const std::string time = std::to_string(100 + i);
    rows += " 0 0 " + std::to_string(0.3 * i) + " 0 0 0 " + time + " host " + time + "\n";
  }
  const std::string log = folder.write("in.clf", rows);
  Configuration c("", {"run.rawlog=" + log, "run.output=" + folder.path("out"),
                       "particle_filter.particles=20", "particle_filter.proposal=standard", "run.refine=0"});
  std::thread robot([&] {
    waitForARun(folder);
    std::filesystem::resize_file(log, rows.size() / 4);
  });
  const std::atomic<bool> stop{false};
  const ReplayOutcome outcome = replay(c, true, stop);
  robot.join();
  EXPECT_THAT(outcome.incomplete, testing::MatchesRegex("log has become shorter while it was read: .*in.clf, "
                                                        "after [0-9]+ of 4000 scans; results cover.*"));
  EXPECT_GT(std::filesystem::file_size(folder.path("out/trajectory.tum")), 1000u);
}

TEST(Replay, ALogThatIsReplacedOrGrowsWhileItIsReadIsAnError) {
  for (const bool isReplaced : {true, false}) {
    SCOPED_TRACE(isReplaced);
    const files::TemporaryFolder folder;
    const std::string log = test::writePlain(folder.path("laps.rawlog"), test::laps(1000)),
                      other = test::writePlain(folder.path("other.rawlog"), test::laps(1000, 40));
    Configuration c("", {"run.rawlog=" + log, "run.output=" + folder.path("out"),
                         "particle_filter.particles=2", "grid.resolution=0.1"});
    std::thread robot([&] {
      waitForARun(folder);
      if (isReplaced)
        std::filesystem::rename(other, log);
      else
        std::ofstream(log, std::ios::app | std::ios::binary) << test::contentOf(other);
    });
    const std::atomic<bool> stop{false};
    const ReplayOutcome outcome = replay(c, true, stop);
    robot.join();
    EXPECT_EQ(outcome.incomplete,
              "log has changed while it was read: " + log + "; results may be of both its states");
    EXPECT_THAT(test::contentOf(folder.path("out/metrics.json")), testing::HasSubstr("\"complete\": false"));
  }
}

// Such scans are dropped if the odometry after them is used; here it is not, as it never changes.
TEST(Replay, ScansBeforeOdometryThatIsNotUsedAreUsed) {
  const files::TemporaryFolder folder;
  test::Log log;
  for (const auto& object : test::logOf(test::drive(2)))
    if (std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(object)) {
      if (log.size() >= 20) log.push_back(test::odometry(1000 + 0.1 * static_cast<double>(log.size()), {}));
      log.push_back(object);
    }
  const std::string file = test::writeGzipped(folder.path("log.rawlog"), log);
  const auto resultsOf = [&](const std::string& name, std::vector<std::string> settings) {
    settings.insert(settings.end(), {"run.rawlog=" + file, "run.output=" + folder.path(name)});
    Configuration c("", settings);
    const std::atomic<bool> stop{false};
    const ReplayOutcome outcome = replay(c, true, stop);
    EXPECT_EQ(outcome.incomplete, "");
    EXPECT_THAT(outcome.warnings, testing::IsEmpty());
    const auto metrics = nlohmann::json::parse(test::contentOf(folder.path(name) + "/metrics.json"));
    EXPECT_EQ(metrics["complete"], true);
    EXPECT_EQ(metrics["scans"], 45);
    EXPECT_EQ(metrics["skipped_readings"], 0);
    return test::contentOf(folder.path(name) + "/trajectory.tum");
  };
  EXPECT_EQ(resultsOf("derived", {}), resultsOf("stated", {"input.require_odometry=false"}));
}

// A disk may be unplugged, a log moved or truncated, hours after the run has begun.
TEST(Replay, ALogThatIsGoneAtTheEndCostsOnlyTheResultsThatNeedIt) {
  const files::TemporaryFolder folder;
  for (const bool isRemoved : {true, false}) {
    SCOPED_TRACE(isRemoved);
    const std::string log = test::writePlain(folder.path("laps.rawlog"), test::laps(1000));
    const std::string output = folder.path(isRemoved ? "removed" : "cut");
    Configuration c("", {"run.rawlog=" + log, "run.output=" + output, "particle_filter.particles=2",
                         "grid.resolution=0.1"});
    const readings::RawlogSummary summary = readings::summarise(log, c.input);
    FilterRun run(c);
    readings::RawlogSource source(log, c.input, summary);
    while (const auto reading = source.next()) run.process(*reading);
    if (isRemoved)
      std::filesystem::remove(log);
    else
      std::filesystem::resize_file(log, std::filesystem::file_size(log) / 2);
    const FinishedRun finished = run.finish(log, summary, nlohmann::ordered_json::object());
    EXPECT_THAT(finished.whyMissing, testing::StartsWith("the log cannot be read again ("));
    EXPECT_THAT(run.takeNotes(), testing::IsSupersetOf({std::string("map not refined: the log has changed"),
                                                        "no map.simplemap.gz: " + finished.whyMissing}));
    const auto metrics = nlohmann::json::parse(test::contentOf(output + "/metrics.json"));
    EXPECT_EQ(metrics["complete"], false);
    EXPECT_EQ(metrics["verdict"], "doubtful");
    for (const char* name : {"map.gridmap.gz", "map.png", "lines.csv", "covariance.csv", "session.hslam"})
      EXPECT_TRUE(std::filesystem::exists(output + "/" + name)) << name;
    EXPECT_FALSE(std::filesystem::exists(output + "/map.simplemap.gz"));
  }
}

TEST(Replay, ARunThatIsStoppedBeforeItsFirstScanReplacesNothing) {
  const files::TemporaryFolder folder;
  const std::string log = test::writeGzipped(folder.path("laps.rawlog"), test::laps(10));
  const std::vector<std::string> settings{"run.rawlog=" + log, "run.output=" + folder.path("out"),
                                          "particle_filter.particles=2", "grid.resolution=0.1"};
  for (const bool stops : {false, true}) {
    SCOPED_TRACE(stops);
    Configuration c("", settings);
    c.run.overwrite = true;
    const std::atomic<bool> stop{stops};
    if (stops) {
      EXPECT_EQ(test::errorOf<std::runtime_error>([&] { replay(c, true, stop); }),
                "interrupted: entry 1 of " + log)
          << "while the log is summarised";
    } else {
      replay(c, true, stop);
    }
    EXPECT_THAT(test::contentOf(folder.path("out/metrics.json")), testing::HasSubstr("\"complete\": true"));
    EXPECT_GT(test::contentOf(folder.path("out/trajectory.tum")).size(), 100u);
  }
}

/// A straight drive to the north-east in steps of 70 m, so that scans do not overlap, between walls 4 m to
/// both sides.
test::Log straightDrive(double length) {
  test::Log log;
  for (int i = 0; i * 70 < length; ++i) {
    const mrpt::math::TPose2D pose(49.5 * i, 49.5 * i, 0);
    const auto scan = test::scan(1000 + 10 * i, {}, 61);
    for (size_t k = 0; k < 61; ++k) scan->setScanRange(k, (k + static_cast<size_t>(i)) % 2 == 0 ? 4.F : 5.F);
    log.push_back(test::odometry(1000 + 10 * i, pose));
    log.push_back(scan);
  }
  return log;
}

TEST(Replay, ADriveOfTenKilometresEndsWithResults) {
  const files::TemporaryFolder folder;
  const std::string log = test::writeGzipped(folder.path("long.rawlog"), straightDrive(10000));
  Configuration c("", {"run.rawlog=" + log, "run.output=" + folder.path("out"), "particle_filter.particles=2",
                       "particle_filter.proposal=standard", "motion_model.turn_var_d=0",
                       "motion_model.turn_mean_std=0", "input.max_odometry_gap=20", "grid.resolution=0.05"});
  const std::atomic<bool> stop{false};
  const ReplayOutcome outcome = replay(c, true, stop);
  EXPECT_THAT(outcome.warnings, testing::Contains(testing::HasSubstr("cells of 0.45 m instead of 0.05 m")));
  EXPECT_THAT(test::contentOf(folder.path("out/map.yaml")), testing::HasSubstr("resolution: 0.45\n"));
  for (const char* name : {"map.png", "map.pgm", "map.gridmap.gz", "trajectory.tum", "metrics.json"})
    EXPECT_GT(std::filesystem::file_size(folder.path(std::string("out/") + name)), 100u) << name;
}

}  // namespace
}  // namespace hybrid_slam::run
