/// What fails during a live run costs only what depends on it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/Errors.h"
#include "files/RawlogReader.h"
#include "live/Recording.h"
#include "testing/ErrorOf.h"
#include "testing/FullDisk.h"
#include "testing/LiveRunTest.h"

namespace hybrid_slam::live {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;
using test::FullDisk;
using test::LiveRunTest;
using testing::HasSubstr;
using testing::MatchesRegex;

TEST_F(LiveRunTest, WithoutAScanThereAreNoResults) {
  EXPECT_THROW(runLive({test::odometry(1, {}), test::odometry(2, {})}), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder.path("live/trajectory.tum")));
  EXPECT_NE(recording(), "");
  EXPECT_THROW(runLive({test::scan(1), test::scan(2)}), std::runtime_error) << "and no odometry";
}

TEST_F(LiveRunTest, AFilterThatFailsLeavesTheRecordingAndTheResultsSoFar) {
  run::Configuration c = configuration("live");
  options.maxWaiting = 1000;
  LiveRun run(c, options, events.log(), true);
  run.setWatcher([](const FilterView& view, const readings::Reading&, bool) {
    if (view.updates() == 5) throw InputError("failure", "fifth update", "expected none");
  });
  const test::Log log = test::laps(40);
  for (const auto& object : log) {
    const auto cycle = CSensoryFrame::Create();
    cycle->insert(std::dynamic_pointer_cast<CObservation>(object));
    run.take(cycle);
  }
  EXPECT_TRUE(test::happens([&] { return run.hasFailed(); }));
  EXPECT_THROW(run.finish(0), InputError);
  files::RawlogReader reader(recording());
  size_t objects = 0;
  while (reader.next()) ++objects;
  EXPECT_EQ(objects, log.size());
  EXPECT_EQ(reader.defect(), "");
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["complete"], false);
}

TEST_F(LiveRunTest, AKilledProgramLeavesAReadableRecording) {
  Recording killed(folder.path(""), "killed.rawlog", events.log());
  killed.keepFree(0);
  for (int i = 0; i < 100; ++i) killed.write(*test::scan(1000 + i));
  killed.flush();
  std::filesystem::copy_file(test::filesIn(folder.path(""), ".partial.killed-20").at(0),
                             folder.path("copy.rawlog"));
  files::RawlogReader reader(folder.path("copy.rawlog"));
  size_t scans = 0;
  while (reader.next()) ++scans;
  EXPECT_EQ(scans, 100u);
  EXPECT_THAT(reader.defect(), HasSubstr("cut off"));
}

/// Returns the error with which a run ends after it has written its results.
std::string errorAtEnd(LiveRun& run) {
  return test::errorOf<std::runtime_error>([&] { run.finish(0); });
}

void take(LiveRun& run, const test::Log& log) {
  for (const auto& object : log) {
    const auto cycle = CSensoryFrame::Create();
    cycle->insert(std::dynamic_pointer_cast<CObservation>(object));
    run.take(cycle);
  }
}

TEST_F(LiveRunTest, AFullDiskEndsTheRecordingNotTheRun) {
  run::Configuration c = configuration("live");
  options.maxWaiting = 1000;
  LiveRun run(c, options, events.log(), true);
  std::optional<FullDisk> disk(40000);
  take(run, test::laps(300));
  EXPECT_EQ(events.count("stopped; the run continues"), 1u) << events.text();
  disk.reset();
  EXPECT_THAT(errorAtEnd(run),
              MatchesRegex("the recording has [0-9]+ of 300 scans: .*; the map is not refined"));
  EXPECT_EQ(events.count("results: 300 scans"), 1u) << events.text();
  files::RawlogReader reader(recording());
  size_t objects = 0;
  while (reader.next()) ++objects;
  EXPECT_GT(objects, 10u);
  EXPECT_LT(objects, 600u);
  mrpt::maps::CSimpleMap map;
  EXPECT_TRUE(map.loadFromFile(folder.path("live/map.simplemap.gz"))) << "as far as the recording goes";
  EXPECT_GT(map.size(), 1u);
  EXPECT_EQ(events.count("map not refined: the recording ends before the run"), 1u) << events.text();
  EXPECT_NEAR(nlohmann::json::parse(result("live/metrics.json"))["duration_s"].get<double>(), 299 * 0.2,
              1e-6);
}

// Scans without odometry are recorded, but are not readings of the run.
TEST_F(LiveRunTest, ARecordingThatEndsBeforeTheFirstOdometryDoesNotCount) {
  run::Configuration c = configuration("live");
  options.maxWaiting = 1000;
  LiveRun run(c, options, events.log(), true);
  test::Log early;
  for (int i = 0; i < 1000; ++i) early.push_back(test::scan(900 + 0.1 * i, {0.002 * i, 0, 0.003 * i}));
  std::optional<FullDisk> disk(10000);
  take(run, early);
  EXPECT_EQ(events.count("stopped; the run continues"), 1u) << events.text();
  take(run, test::laps(30));
  disk.reset();
  EXPECT_THAT(errorAtEnd(run), HasSubstr("the recording has 0 of 35 scans"));
  EXPECT_EQ(events.count("results: without those that need the recording (it ends before"), 1u)
      << events.text();
  EXPECT_FALSE(std::filesystem::exists(folder.path("live/map.simplemap.gz")));
}

TEST_F(LiveRunTest, TheRecordingStopsBeforeItTakesTheDiskSpaceOfTheResults) {
  Recording recording(folder.path(""), "kept.rawlog", events.log());
  recording.keepFree(0);
  for (int i = 0; i < 100; ++i) recording.write(*test::scan(1000 + i));
  EXPECT_EQ(events.count("recording: "), 0u) << events.text();
  recording.keepFree(1e18);
  for (int i = 100; i < 200; ++i) recording.write(*test::scan(1000 + i));
  EXPECT_EQ(events.count("recording: stopped; the run continues (disk almost full"), 1u) << events.text();
  EXPECT_EQ(entriesOf(recording.path()), 100u) << "complete up to there, under its final name";
}

TEST_F(LiveRunTest, ADiskWithoutTheReserveCostsOnlyTheRecording) {
  options.maxWaiting = 1000, options.diskReserve = 1e9;
  EXPECT_THAT(test::errorOf<std::runtime_error>([&] { runLive(test::laps(30)); }),
              HasSubstr("the recording has 0 of 30 scans"));
  EXPECT_EQ(events.count("recording: stopped; the run continues (disk almost full"), 1u) << events.text();
  EXPECT_EQ(events.count("results: without those that need the recording"), 1u) << events.text();
  EXPECT_FALSE(result("live/trajectory.tum").empty());
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["complete"], false);
}

TEST_F(LiveRunTest, ADiskThatIsFullUntilTheEndCostsOnlyWhatNeedsTheRecording) {
  run::Configuration c = configuration("live");
  options.maxWaiting = 1000;
  LiveRun run(c, options, events.log(), true);
  std::atomic<size_t> filtered{0};
  run.setWatcher([&](const FilterView&, const readings::Reading&, bool) { ++filtered; });
  std::optional<FullDisk> disk(0);
  take(run, test::laps(300));
  EXPECT_TRUE(test::happens([&] { return filtered == 300; }));
  disk.reset();
  EXPECT_THAT(errorAtEnd(run), HasSubstr("the recording has 0 of 300 scans"));
  EXPECT_EQ(std::filesystem::file_size(recording()), 0u);
  EXPECT_EQ(events.count("results: without those that need the recording (empty file"), 1u) << events.text();
  for (const char* name : {"trajectory.tum", "map.png", "map.pgm", "lines.csv", "plan.svg", "session.hslam"})
    EXPECT_FALSE(result(std::string("live/") + name).empty()) << name;
  EXPECT_FALSE(std::filesystem::exists(folder.path("live/map.simplemap.gz")));
  const auto metrics = nlohmann::json::parse(result("live/metrics.json"));
  EXPECT_NEAR(metrics["duration_s"].get<double>(), 299 * 0.2, 1e-6);
  EXPECT_EQ(metrics["complete"], false);
  EXPECT_EQ(metrics["verdict"], "doubtful");
  const std::string steps = result("live/steps.csv");
  EXPECT_EQ(metrics["updates"], std::count(steps.begin(), steps.end(), '\n') - 1);
}

TEST_F(LiveRunTest, ARemovedRecordingCostsOnlyWhatNeedsIt) {
  run::Configuration c = configuration("live");
  options.maxWaiting = 1000;
  LiveRun run(c, options, events.log(), true);
  take(run, test::laps(30));
  for (const std::string& file : test::filesIn(folder.path("live"), ".partial."))
    EXPECT_TRUE(std::filesystem::remove(file));
  EXPECT_THAT(errorAtEnd(run), HasSubstr("the recording has 0 of 30 scans"));
  EXPECT_EQ(events.count("recording: stopped"), 1u) << events.text();
  EXPECT_FALSE(result("live/trajectory.tum").empty());
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["complete"], false);
}

TEST_F(LiveRunTest, AMissingResultIsAnError) {
  run::Configuration c = configuration("live");
  options.maxWaiting = 1000;
  EventLog log("test", [this](const std::string& line) {
    if (line.find("2 cycles of the server") != std::string::npos) {  // after the recording was summarised
      EXPECT_TRUE(std::filesystem::remove(recording()));
    }
  });
  LiveRun run(c, options, log, true);
  take(run, test::laps(30));
  EXPECT_THAT(test::errorOf<std::runtime_error>([&] { run.finish(2); }), HasSubstr("results are missing: "));
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["complete"], false);
  EXPECT_FALSE(result("live/map.png").empty());
}

// No thread can have such a stack.
TEST_F(LiveRunTest, AMapThatCannotBeJudgedDoesNotEndTheRun) {
  options.maxWaiting = 1000;
  run::Configuration c = configuration("live");
  c.filter.filter.threads = 1;
  LiveRun run(c, options, events.log(), true);
  run.setStateInterval(0);
  pthread_attr_t before, huge;
  ASSERT_EQ(::pthread_getattr_default_np(&before), 0);
  ::pthread_attr_init(&huge);
  ASSERT_EQ(::pthread_attr_setstacksize(&huge, size_t{1} << 47), 0);
  ASSERT_EQ(::pthread_setattr_default_np(&huge), 0);
  for (const auto& object : test::laps(30)) {
    const auto cycle = CSensoryFrame::Create();
    cycle->insert(std::dynamic_pointer_cast<CObservation>(object));
    run.take(cycle);
  }
  EXPECT_TRUE(test::happens([&] { return events.count("map: not judged: ") > 0; })) << events.text();
  ::pthread_setattr_default_np(&before);
  ::pthread_attr_destroy(&huge);
  ::pthread_attr_destroy(&before);
  EXPECT_THAT(run.finish(0), HasSubstr("30 scans"));
}

TEST_F(LiveRunTest, ACheckpointThatCannotBeWrittenDoesNotEndTheRun) {
  run::Configuration c = configuration("live");
  c.run.checkpointEvery = 0.001;
  options.maxWaiting = 1000;
  LiveRun run(c, options, events.log(), true);
  const std::string inTheWay = folder.path("live/session.hslam");
  std::filesystem::create_directory(inTheWay);
  const auto take = [&](const auto& object) {
    const auto cycle = CSensoryFrame::Create();
    cycle->insert(std::dynamic_pointer_cast<CObservation>(object));
    run.take(cycle);
  };
  const auto lap = test::laps(1000);
  size_t taken = 0;
  // A checkpoint is written beside the filter and is reported with a later scan.
  EXPECT_TRUE(test::happens([&] {
    if (taken < lap.size()) take(lap[taken++]);
    return events.count("no checkpoint: ") > 0;
  })) << events.text();
  std::filesystem::remove(inTheWay);
  EXPECT_THAT(run.finish(0), HasSubstr(std::to_string(taken / 2) + " scans"));
  EXPECT_FALSE(result("live/session.hslam").empty());
}

}  // namespace
}  // namespace hybrid_slam::live
