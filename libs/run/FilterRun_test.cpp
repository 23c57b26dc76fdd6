#include "run/FilterRun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/Errors.h"
#include "files/Gzip.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "testing/ErrorOf.h"
#include "testing/FilterRunTest.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using test::FilterRunTest;
using testing::Conditional;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// The map of the recorded part would not be that of the run.
TEST_F(FilterRunTest, ARecordingThatEndsBeforeTheRunDoesNotCutItsMap) {
  makePlain();
  Configuration c = configuration("cut", {"grid.resolution=0.1"});
  FilterRun run(c);
  process(run, c);
  finish(run, c, test::writeGzipped(folder.path("recording.rawlog"), test::laps(10)));
  EXPECT_THAT(run.takeNotes(), Contains("map not refined: the recording ends before the run"));
  expectPlain("cut");
  const auto metrics = nlohmann::json::parse(result("cut/metrics.json"));
  EXPECT_NEAR(metrics["duration_s"].get<double>(), 99 * 0.2, 1e-6);
  EXPECT_EQ(metrics["complete"], false);
  EXPECT_EQ(metrics["verdict"], "doubtful");
}

TEST_F(FilterRunTest, IsNotRefinedIfTheScansNeedTooMuchMemory) {
  makePlain();
  for (const double limit : {2e5, 3e5}) {  // they need 223 kB
    SCOPED_TRACE(limit);
    const std::string output = "limit" + std::to_string(limit);
    Configuration c = configuration(output, {"grid.resolution=0.1"});
    FilterRun run(c);
    run.limitRefinement(limit);
    process(run, c);
    finish(run, c, log);
    const auto notes = run.takeNotes();
    const bool isRefined = limit > 2.5e5;
    EXPECT_EQ(std::count(notes.begin(), notes.end(), "map not refined: the scans need 0.0 GB, over 0.0 GB"),
              isRefined ? 0 : 1);
    if (isRefined) {
      EXPECT_NE(result(output + "/trajectory.tum"), result("plain/trajectory.tum"));
    } else {
      expectPlain(output);
    }
  }
}

TEST_F(FilterRunTest, ARunThatFillsTheMemoryEndsWithResultsAndASession) {
  Configuration c = configuration("full");
  FilterRun run(c);
  run.limitMemory(1e6);
  EXPECT_THROW(process(run, c), std::runtime_error);
  EXPECT_EQ(run.scans(), 1u);
  finish(run, c, log);
  EXPECT_THAT(run.takeNotes(), Contains("map not refined: out of memory"));
  EXPECT_EQ(nlohmann::json::parse(result("full/metrics.json"))["complete"], false);
  EXPECT_TRUE(std::filesystem::exists(folder.path("full/session.hslam")));
}

TEST_F(FilterRunTest, TheSessionHoldsTheMapWithAndWithoutRefinement) {
  for (const char* refine : {"run.refine=0", "run.refine=1"})
    for (const char* method : {"run.method=hybrid", "run.method=general"}) {
      Configuration c = configuration("mapped", {"grid.resolution=0.1", refine, method});
      c.run.overwrite = true;
      FilterRun run(c);
      process(run, c);
      finish(run, c, log);
      EXPECT_FALSE(
          SessionReader(folder.path("mapped/session.hslam")).header().map.grid.tiles().bounds().empty())
          << refine << " " << method;
    }
}

TEST_F(FilterRunTest, ASessionThatWouldFillTheMemoryIsLeftOut) {
  Configuration c = configuration("large");
  FilterRun run(c);
  run.limitSession(1e4);
  process(run, c);
  finish(run, c, log);
  EXPECT_THAT(run.takeNotes(), Contains("no session: over 0.0 GB"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("large/session.hslam")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("large/map.png")));
}

/// The odometry stands still for 8 s while the robot drives half a lap.
TEST_F(FilterRunTest, StuckOdometryIsReplacedByTheScans) {
  test::Log stuck = test::laps(160);
  for (size_t i = 60; i < 100; ++i)
    stuck[2 * i] = test::odometry(1000 + 0.2 * static_cast<double>(i), test::poseOnLap(59, 80));
  const std::string file = test::writeGzipped(folder.path("stuck.rawlog"), stuck);
  const auto worstOf = [&](const std::string& output, const std::string& setting) {
    Configuration c = configuration(output, {"input.replace_stuck_odometry=" + setting});
    c.run.rawlog = file;
    FilterRun run(c);
    readings::RawlogSource source(file, c.input, readings::summarise(file, c.input));
    while (const auto reading = source.next()) run.process(*reading);
    EXPECT_THAT(run.warnings(),
                Conditional(setting == "false", IsEmpty(), Contains(HasSubstr("stood still"))));
    finish(run, c, file);
    EXPECT_EQ(run.takeNotes().size(), setting == "false" ? 0u : 1u);
    const auto trajectory = files::loadTum(folder.path(output + "/trajectory.tum"));
    EXPECT_EQ(trajectory.size(), 160u);
    double worst = 0;
    for (size_t i = 0; i < trajectory.size(); ++i)
      worst =
          std::max(worst, (trajectory[i].pose - (test::poseOnLap(i, 80) - test::poseOnLap(0, 80))).norm());
    return worst;
  };
  EXPECT_LT(worstOf("replaced", "true"), 0.15);
  EXPECT_GT(worstOf("used", "false"), 1.5);
}

// A large session takes seconds to compress and to sync; scans of a live robot would be skipped.
TEST_F(FilterRunTest, GoesOnWhileACheckpointIsWritten) {
  Configuration c = configuration("out");
  c.run.checkpointEvery = 1e-3;
  FilterRun run(c);
  std::promise<void> allProcessed;
  std::shared_future<void> processed(allProcessed.get_future());
  std::atomic<int> begun{0}, waitedInVain{0};
  run.setBeforeSession([&] {
    ++begun;
    waitedInVain += processed.wait_for(std::chrono::seconds(20)) != std::future_status::ready;
  });
  process(run, c);
  const int begunMeanwhile = begun;
  allProcessed.set_value();
  run.finishCheckpoint();
  EXPECT_LE(begunMeanwhile, 1) << "one at a time";
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(waitedInVain, 0);
  SessionReader session(folder.path("out/session.hslam"));
  EXPECT_FALSE(session.header().times.empty());
  finish(run, c, log);
  EXPECT_EQ(run.takeNotes(), std::vector<std::string>());
}

TEST_F(FilterRunTest, AnUpdateThatFailsLeavesResultsWithoutASession) {
  Configuration c = configuration(
      "out", {"grid.resolution=0.1", "motion_model.turn_var_d=0", "motion_model.turn_mean_std=0"});
  FilterRun run(c);
  process(run, c);
  readings::Reading far;
  far.scans = {test::scan(1100)};
  far.timestamp = 1100;
  far.motion = {5e5, 5e5, 0};
  EXPECT_THROW(run.process(far), InputError) << "the map is too large";
  finish(run, c, log);
  EXPECT_THAT(run.takeNotes(), Contains("no session: the filter failed inside an update"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/session.hslam")));
  const std::string steps = result("out/steps.csv");
  EXPECT_EQ(nlohmann::json::parse(result("out/metrics.json"))["updates"],
            std::count(steps.begin(), steps.end(), '\n') - 1);
}

TEST_F(FilterRunTest, ResultsWithoutASessionKeepTheLastCheckpoint) {
  Configuration c = configuration("out", {"grid.resolution=0.1"});
  c.run.checkpointEvery = 1e-9;
  FilterRun run(c);
  process(run, c);
  readings::Reading far;
  far.scans = {test::scan(1100)};
  far.timestamp = 1100;
  far.motion = {5e7, 5e7, 0};
  EXPECT_THROW(run.process(far), InputError);
  run.finishCheckpoint();
  const std::string before = result("out/session.hslam");
  EXPECT_FALSE(before.empty());
  finish(run, c, log);
  EXPECT_THAT(run.takeNotes(), Contains("the last checkpoint stays: " + folder.path("out/session.hslam")));
  EXPECT_EQ(result("out/session.hslam"), before);
  EXPECT_FALSE(result("out/metrics.json").empty());

  // As if killed after the checkpoint.
  std::filesystem::create_directory(folder.path("resumed"));
  std::filesystem::copy(folder.path("out/session.hslam"), folder.path("resumed"));
  Configuration resumed = c;
  resumed.run.output = folder.path("resumed");
  resumed.run.resume = folder.path("resumed/session.hslam");
  SessionReader session(resumed.run.resume);
  FilterRun again(resumed);
  again.limitSession(1e4);  // a smaller machine
  again.resume(session);
  finish(again, resumed, log);
  EXPECT_EQ(result("resumed/session.hslam"), before);
  EXPECT_FALSE(result("resumed/metrics.json").empty());
}

TEST_F(FilterRunTest, TheCellsOfTheMapThatItContinuesAreNotCoarser) {
  Configuration first = configuration("first", {"grid.resolution=0.1"});
  {
    FilterRun run(first);
    process(run, first);
    finish(run, first, log);
  }
  Configuration second = configuration("second");
  second.run.continueFrom = folder.path("first/session.hslam");
  second.run.start.emplace(0, 0, 0);
  FilterRun run(second);
  process(run, second);
  EXPECT_EQ(finish(run, second, log).mapNote, "");
}

// A match in a map of larger cells is less certain.
TEST_F(FilterRunTest, TheCovarianceOfALocalisationGrowsWithTheCells) {
  for (const double cell : {0.05, 0.2}) {
    SCOPED_TRACE(cell);
    const std::string setting = "grid.resolution=" + std::to_string(cell);
    Configuration mapped = configuration("mapped", {setting});
    mapped.run.overwrite = true;
    {
      FilterRun run(mapped);
      process(run, mapped);
      finish(run, mapped, log);
    }
    Configuration c = configuration("localized");
    c.run.overwrite = true;
    c.run.localizeIn = folder.path("mapped/session.hslam");
    c.run.start.emplace(0, 0, 0);
    FilterRun run(c);
    process(run, c);
    finish(run, c, log);
    std::istringstream rows(result("localized/covariance.csv"));
    std::string row;
    std::getline(rows, row);
    double least = 1, time = 0, xx = 0;
    char comma = 0;
    while (std::getline(rows, row) && std::istringstream(row) >> time >> comma >> xx)
      least = std::min(least, xx);
    const double deviation = 0.01 * cell / 0.05;  // m
    EXPECT_GE(least, deviation * deviation);
    EXPECT_LT(least, 4 * deviation * deviation);
  }
}

TEST_F(FilterRunTest, ResultsDoNotReplaceAnInput) {
  Configuration first = configuration("out");
  {
    FilterRun run(first);
    process(run, first);
    finish(run, first, log);
  }
  const std::vector<std::pair<std::string RunOptions::*, std::string>> inputs = {
      {&RunOptions::localizeIn, "session.hslam"},   {&RunOptions::localizeIn, "map.yaml"},
      {&RunOptions::continueFrom, "session.hslam"}, {&RunOptions::continueFrom, "map.yaml"},
      {&RunOptions::priorPlan, "plan.geojson"},     {&RunOptions::rawlog, "trajectory.tum"}};
  for (const auto& [input, name] : inputs) {
    Configuration again = configuration("out");
    again.run.overwrite = true;
    again.run.*input = folder.path("out/" + name);
    EXPECT_THAT(test::errorOf([&] { FilterRun run(again); }),
                HasSubstr("the results would replace an input: " + folder.path("out/" + name)));
  }
  std::string yaml = test::contentOf(folder.path("out/map.yaml"));
  yaml.replace(yaml.find("map.pgm"), 7, "out/map.pgm");
  folder.write("elsewhere.yaml", yaml);
  for (std::string RunOptions::*input : {&RunOptions::continueFrom, &RunOptions::localizeIn}) {
    Configuration again = configuration("out");
    again.run.overwrite = true;
    again.run.*input = folder.path("elsewhere.yaml");
    EXPECT_THAT(test::errorOf([&] { FilterRun run(again); }),
                HasSubstr("the results would replace an input: " + folder.path("out/map.pgm")));
  }
  Configuration again(folder.path("out/config.ini"), {"run.output=" + folder.path("out")});
  again.run.overwrite = true;
  EXPECT_THAT(test::errorOf([&] { FilterRun run(again); }), HasSubstr("would replace an input"));
}

TEST_F(FilterRunTest, AStartOutOfViewOfTheMapIsAnError) {
  Configuration first = configuration("first");
  {
    FilterRun run(first);
    process(run, first);
    finish(run, first, log);
  }
  for (std::string RunOptions::*use : {&RunOptions::continueFrom, &RunOptions::localizeIn})
    for (const mrpt::math::TPose2D& start :
         {mrpt::math::TPose2D(-60, 0, 0), {60, 0, 0}, {0, -60, 0}, {0, 60, 0}}) {
      Configuration second = configuration("second");
      second.run.*use = folder.path("first/session.hslam");
      second.run.start = start;
      EXPECT_THAT(
          test::errorOf([&] { FilterRun run(second); }),
          testing::HasSubstr("start out of view of the map: command line, option --start; expected at most"));
    }
}

/// A robot in surroundings that look the same after a turn of 24 deg.
struct SearchInAPlan : testing::Test {
  Configuration configuration(const std::string& output) const {
    return {
        "",
        {"run.output=" + folder.path(output), "particle_filter.particles=2", "loop_closing.enabled=false"}};
  }
  /// Processes scans, each after a turn by an angle (rad).
  void process(FilterRun& run, int scans, double angle) {
    for (int k = 0; k < scans; ++k) {
      const auto scan = test::scan(1000 + reading.timestamp, {}, 61);
      for (size_t i = 0; i < 61; ++i) scan->setScanRange(i, i % 2 == 0 ? 4.F : 5.F);
      reading.scans = {scan};
      reading.timestamp += 1;
      reading.motion = {0, 0, angle};
      run.process(reading);
    }
  }
  const double turn = mrpt::DEG2RAD(24.0);
  const files::TemporaryFolder folder;
  const std::string plan = folder.write(
      "plan.geojson",
      R"({"features":[{"geometry":{"type":"LineString","coordinates":[[0,0],[3,0],[3,2],[0,0]]}}]})");
  readings::Reading reading;
};

// A search without end would keep its maps, and the run would have no checkpoints.
TEST_F(SearchInAPlan, IsOverOnceTheRobotHasMovedFarAndTheRunSavesItself) {
  Configuration c = configuration("out");
  c.run.priorPlan = plan;
  FilterRun run(c);
  process(run, 500, 0);
  EXPECT_EQ(run.state(), "") << "a robot that stands is searched when it drives";
  EXPECT_THROW(run.saveMapTo(folder.path("early")), std::runtime_error);
  EXPECT_THAT(run.placeNote(), HasSubstr("place not found in the floor plan"));
  process(run, 240, turn);
  EXPECT_NE(run.state(), "");
  run.saveMapTo(folder.path("late"));
  EXPECT_THAT(run.placeNote(), HasSubstr("place not found in the floor plan"));
}

TEST_F(SearchInAPlan, AResumedRunSaysThatThePlaceWasNotFound) {
  {
    Configuration c = configuration("out");
    c.run.priorPlan = plan;
    FilterRun run(c);
    process(run, 241, turn);
    EXPECT_TRUE(run.hasEarlierMap());
    run.saveMapTo(folder.path("saved"));
  }
  SessionReader session(folder.path("saved/session.hslam"));
  Configuration c = configuration("resumed");
  FilterRun resumed(c);
  resumed.resume(session);
  EXPECT_THAT(resumed.placeNote(), HasSubstr("place not found in the floor plan: 241 scans"));
  EXPECT_TRUE(resumed.hasEarlierMap());
}

TEST_F(SearchInAPlan, LeavesNoScansInMemory) {
  std::vector<size_t> bytes;
  for (const std::string& file : {plan, std::string()}) {
    reading = {};
    Configuration c = configuration(file.empty() ? "without" : "with");
    c.run.priorPlan = file;
    FilterRun run(c);
    process(run, 250, turn);
    bytes.push_back(run.state().size());
  }
  EXPECT_NEAR(static_cast<double>(bytes[0]), static_cast<double>(bytes[1]), 5000)
      << "the scans are 60 kB, the digits of the times in steps.csv may differ";
}

// Otherwise the fuzz target stops at the header, because older layouts are refused.
TEST(FilterRun, GoesOnFromTheSessionsOfTheFuzzCorpus) {
  const files::TemporaryFolder folder;
  size_t sessions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/tests/fuzz/corpus/session")) {
    SCOPED_TRACE(entry.path());
    const std::string zipped =
        folder.write("session.hslam", files::gzipped(test::contentOf(entry.path().string())));
    SessionReader session(zipped);
    Configuration configuration("", {"particle_filter.particles=2", "run.output=" + folder.path("out")});
    FilterRun run(configuration);
    EXPECT_NO_THROW(run.resume(session)) << "made by hybrid-slam -n 2, uncompressed";
    EXPECT_GT(run.scans(), 0u);
    ++sessions;
  }
  EXPECT_EQ(sessions, 3u);
}

}  // namespace
}  // namespace hybrid_slam::run
