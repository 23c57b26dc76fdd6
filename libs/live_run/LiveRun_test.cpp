/// A live run, and the replay of its recording.
#include "live_run/LiveRun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <sys/resource.h>

#include <csignal>
#include <future>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/Errors.h"
#include "files/RawlogReader.h"
#include "files/TemporaryFolder.h"
#include "live/CycleGrouper.h"
#include "readings/SweepTimes.h"
#include "run/Replay.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::live {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;
using test::contentOf;
using testing::HasSubstr;

class LiveRunTest : public testing::Test {
 protected:
  run::Configuration configuration(const std::string& output, const std::string& more = "") {
    const std::string ini =
        folder.write("run.ini",
                     "[particle_filter]\nparticles = 5\nproposal = standard\nupdate_distance = 0.2\n[grid]\n"
                     "resolution = 0.1\n" +
                         more);
    return run::Configuration(ini, {"run.output=" + folder.path(output)});
  }
  /// Passes the log's observations through a grouper to a live run. @return the summary
  std::string runLive(const test::Log& log, const std::string& more = "") {
    run::Configuration c = configuration("live", more);
    LiveRun run(c, options, events.log(), true);
    run.setStateInterval(stateInterval);
    CycleGrouper grouper(0, [&](const CSensoryFrame::Ptr& cycle) { run.take(cycle); });
    for (const auto& object : log) grouper.add(std::dynamic_pointer_cast<CObservation>(object));
    grouper.finish();
    return run.finish(3);
  }
  void replayRecording(const std::string& more = "") {
    run::Configuration c = configuration("offline", more);
    c.run.rawlog = recording();
    c.run.overwrite = true;
    const std::atomic<bool> stop{false};
    run::replay(c, true, stop);
  }
  /// Returns the newest recording; empty if there is none.
  std::string recording() const {
    const auto all = test::filesIn(folder.path("live"), "recording-");
    return all.empty() ? "" : all.back();
  }
  std::string result(const std::string& name) const { return test::contentOf(folder.path(name)); }
  void expectSameResults() {
    for (const char* name : {"trajectory.tum", "map.pgm", "map.yaml", "lines.csv"}) {
      EXPECT_EQ(result(std::string("live/") + name), result(std::string("offline/") + name)) << name;
      EXPECT_FALSE(result(std::string("live/") + name).empty()) << name;
    }
    EXPECT_EQ(result("live/map.simplemap.gz"), result("offline/map.simplemap.gz"));
  }

  files::TemporaryFolder folder;
  test::Events events;
  LiveOptions options;
  double stateInterval = 10;  // s
};

TEST_F(LiveRunTest, TheReplayOfItsRecordingGivesTheSameBytes) {
  options.maxWaiting = 1000;
  EXPECT_THAT(runLive(test::laps(100)), HasSubstr("100 scans"));
  replayRecording();
  expectSameResults();
  const auto metrics = nlohmann::json::parse(result("live/metrics.json"));
  EXPECT_EQ(metrics["skipped"], 0);
  EXPECT_EQ(metrics["lost_cycles"], 3);
  EXPECT_GT(metrics["latency_ms"]["median"], 0);
  EXPECT_GE(metrics["latency_ms"]["p99"], metrics["latency_ms"]["median"]);
  EXPECT_NEAR(metrics["duration_s"].get<double>(), 99 * 0.2, 1e-6);
}

/// The log states the scan time before its first odometry, or the setting does.
TEST_F(LiveRunTest, ScansAreCorrectedForTheMotionDuringTheirSweepAndReplayedSo) {
  options.maxWaiting = 1000;
  test::Log log{readings::commentOf({"LASER", 0.1}, test::stamp(998))};
  for (int i = 0; i < 10; ++i) log.push_back(test::scan(998 + 0.1 * i));
  const test::Log laps = test::laps(60);
  log.insert(log.end(), laps.begin(), laps.end());
  runLive(log);
  replayRecording();
  expectSameResults();
  const std::string told = result("offline/trajectory.tum");
  replayRecording("[input]\nscan_time = 0.1\n");
  EXPECT_EQ(result("offline/trajectory.tum"), told);
  replayRecording("[input]\nscan_time = 0\n");
  EXPECT_NE(result("offline/trajectory.tum"), told);
}

/// MRPT's filter also depends only on the seed, in any thread.
TEST_F(LiveRunTest, TheReplayWithMrptsFilterGivesTheSameBytes) {
  options.maxWaiting = 1000;
  const std::string more = "[run]\nmethod = stock\n";
  runLive(test::laps(100), more);
  replayRecording(more);
  expectSameResults();
}

TEST_F(LiveRunTest, TheReplayOfUnsynchronisedSensorsGivesTheSameBytes) {
  options.maxWaiting = 1000;
  test::Log log;
  log.push_back(test::scan(999.9, test::poseOnLap(0, 80)));
  for (size_t i = 0; i < 60; ++i) {
    const double time = 1000 + 0.2 * static_cast<double>(i);
    log.push_back(test::odometry(time, test::poseOnLap(i, 80)));
    if (i != 30) log.push_back(test::scan(time + (i % 4 == 1 ? 0.03 : 0.17), test::poseOnLap(i, 80)));
    if (i == 20) log.push_back(test::odometry(time + 0.01, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
    if (i == 40) log.push_back(test::scan(time + 0.18, {}, 0));
    if (i == 50) log.push_back(test::scan(time + 0.18, {}, 91, "REAR"));
  }
  runLive(log);
  replayRecording();
  expectSameResults();
}

TEST_F(LiveRunTest, WithoutOdometryIfItIsNotRequired) {
  options.maxWaiting = 1000;
  test::Log log;
  for (size_t i = 0; i < 30; ++i) {
    log.push_back(test::scan(1000 + 0.2 * static_cast<double>(i)));
    if (i == 10) log.push_back(test::odometry(1002.1, {1, 0, 0}));
  }
  const std::string more = "[input]\nrequire_odometry = false\n";
  EXPECT_THAT(runLive(log, more), HasSubstr("30 scans"));
  replayRecording(more);
  expectSameResults();
}

TEST_F(LiveRunTest, ALateFilterSkipsScansAndKeepsTheirMotion) {
  options.maxWaiting = 1;
  constexpr size_t kScans = 100;
  run::Configuration c = configuration("live");
  LiveRun run(c, options, events.log(), true);
  std::promise<void> sent;
  run.setWatcher([all = sent.get_future().share()](const FilterView&, const readings::Reading&, bool) {
    all.wait();  // the filter is late
  });
  for (size_t i = 0; i < kScans; ++i) {
    const double time = 1000 + 0.2 * static_cast<double>(i);
    const test::TPose2D pose(0.01 * static_cast<double>(i), 0, 0);
    const auto cycle = CSensoryFrame::Create();
    cycle->insert(test::odometry(time, pose));
    cycle->insert(test::scan(time, pose));
    run.take(cycle);
  }
  sent.set_value();
  run.finish(0);
  const auto metrics = nlohmann::json::parse(result("live/metrics.json"));
  EXPECT_EQ(metrics["scans"].get<size_t>() + metrics["skipped"].get<size_t>(), kScans);
  EXPECT_GT(metrics["skipped"], 0);
  EXPECT_NEAR(metrics["distance_m"].get<double>(), 0.01 * (kScans - 1), 1e-6);
  EXPECT_GE(events.count("late: "), 1u);
  replayRecording();
  EXPECT_EQ(nlohmann::json::parse(result("offline/metrics.json"))["scans"], kScans)
      << "the recording has all";
}

TEST_F(LiveRunTest, TellsWhenTheMapIsLost) {
  options.maxWaiting = 1000, stateInterval = 0;
  runLive(test::lapsWithMirroredOdometry(240));
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["verdict"], "lost");
  EXPECT_GT(events.count("map: verdict: lost: "), 0u) << events.text();
}

TEST_F(LiveRunTest, SaysNothingOfAGoodMap) {
  options.maxWaiting = 1000, stateInterval = 0;
  runLive(test::laps(240));
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["verdict"], "consistent");
  EXPECT_EQ(events.count("map: verdict"), 0u) << events.text();
}

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

TEST_F(LiveRunTest, EachLaserThatIsUsedIsReportedOnce) {
  options.maxWaiting = 1000;
  test::Log log = test::laps(10);
  for (size_t i = 0; i < 10; ++i)
    log.insert(log.begin() + static_cast<std::ptrdiff_t>(3 * i) + 2,
               test::scan(1000 + 0.2 * static_cast<double>(i), test::poseOnLap(i, 80), 91, "REAR"));
  runLive(log);
  EXPECT_EQ(events.count("laser `LASER`: used, 181 beams"), 1u) << events.text();
  EXPECT_EQ(events.count("laser `REAR`: used, 91 beams"), 1u) << events.text();
  EXPECT_EQ(events.count("laser `"), 2u) << events.text();
}

TEST_F(LiveRunTest, ManyLasersThatAreNotUsedFillNeitherLogNorMemory) {
  options.maxWaiting = 1000;
  test::Log log = test::laps(10);
  for (int i = 0; i < 200; ++i) {
    const auto scan = test::scan(1000.1, {}, 3, "LASER" + std::to_string(i));
    scan->sensorPose.x(1e5);
    log.insert(log.begin() + 2, scan);
  }
  runLive(log);
  EXPECT_EQ(events.count("scan not used"), 100u);
}

TEST_F(LiveRunTest, WhatCannotBeTrueIsSkippedAndReported) {
  options.maxWaiting = 1000;
  test::Log log = test::laps(40);
  std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(log[20])->odometry.x(1e5);
  std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(log[41])->sensorPose.x(1e5);
  EXPECT_THAT(runLive(log), HasSubstr("39 scans"));
  EXPECT_EQ(events.count("jumps by over 100 m"), 1u) << events.text();
  EXPECT_THAT(events.text(), HasSubstr("entry 21 of " + folder.path("live/recording-")));
  EXPECT_EQ(events.count("its sensor pose is over 100 m"), 1u) << events.text();
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["skipped_readings"], 3);
  replayRecording();
  expectSameResults();
}

TEST_F(LiveRunTest, AnotherRunInTheSameFolderTouchesNothing) {
  options.maxWaiting = 1000;
  runLive(test::laps(20));
  const auto before = test::filesIn(folder.path("live"), "");
  const std::string first = recording(), recorded = test::contentOf(first),
                    metrics = result("live/metrics.json");
  {
    run::Configuration c = configuration("live");
    LiveRun run(c, options, events.log(), true);  // without data
    EXPECT_THROW(run.finish(0), std::runtime_error);
  }
  EXPECT_EQ(test::filesIn(folder.path("live"), ""), before);
  EXPECT_THAT(runLive(test::laps(20)), HasSubstr("20 scans"));
  EXPECT_GE(events.count("has results of an earlier run"), 1u) << events.text();
  EXPECT_EQ(test::contentOf(first), recorded);
  EXPECT_EQ(result("live/metrics.json"), metrics);
}

TEST_F(LiveRunTest, AKilledProgramLeavesAReadableRecording) {
  Recording killed(folder.path(""), "killed.rawlog", events.log());
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

TEST_F(LiveRunTest, AFullDiskEndsTheRecordingNotTheRun) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  run::Configuration c = configuration("live");
  options.maxWaiting = 1000;
  LiveRun run(c, options, events.log(), true);
  const rlimit small{40000, before.rlim_max};  // bytes of a file
  ::setrlimit(RLIMIT_FSIZE, &small);
  for (const auto& object : test::laps(300)) {
    const auto cycle = CSensoryFrame::Create();
    cycle->insert(std::dynamic_pointer_cast<CObservation>(object));
    run.take(cycle);
  }
  EXPECT_EQ(events.count("stopped; the run continues"), 1u) << events.text();
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(run.finish(0), HasSubstr("300 scans"));
  files::RawlogReader reader(recording());
  size_t objects = 0;
  while (reader.next()) ++objects;
  EXPECT_GT(objects, 10u);
  EXPECT_LT(objects, 600u);
  mrpt::maps::CSimpleMap map;
  EXPECT_TRUE(map.loadFromFile(folder.path("live/map.simplemap.gz"))) << "as far as the recording goes";
  EXPECT_GT(map.size(), 1u);
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
  for (const auto& object : test::laps(30)) take(object);
  ASSERT_TRUE(test::happens([&] { return events.count("no checkpoint: ") > 0; })) << events.text();
  std::filesystem::remove(inTheWay);
  EXPECT_THAT(run.finish(0), HasSubstr("30 scans"));
  EXPECT_FALSE(result("live/session.hslam").empty());
}

TEST_F(LiveRunTest, WrongRecordingNames) {
  run::Configuration c = configuration("live");
  for (const char* name : {"", "a/b.rawlog"}) {
    options.recording = name;
    EXPECT_THROW(LiveRun(c, options, events.log(), true), InputError) << name;
  }
}

}  // namespace
}  // namespace hybrid_slam::live
