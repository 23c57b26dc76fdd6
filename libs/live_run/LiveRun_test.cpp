/// A live run, and the replay of its recording.
#include "live_run/LiveRun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "base/Errors.h"
#include "readings/SweepTimes.h"
#include "testing/LiveRunTest.h"
#include "testing/NoisyLog.h"

namespace hybrid_slam::live {
namespace {

using mrpt::obs::CSensoryFrame;
using test::LiveRunTest;
using testing::HasSubstr;

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

TEST_F(LiveRunTest, ScansBeforeTheFirstOdometryAreRecordedAndCounted) {
  options.maxWaiting = 1000;
  test::Log log;
  for (int i = 0; i < 20; ++i) log.push_back(test::scan(996 + 0.2 * i));
  const test::Log laps = test::laps(30);
  log.insert(log.end(), laps.begin(), laps.end());
  EXPECT_THAT(runLive(log), HasSubstr("35 scans"));
  EXPECT_EQ(events.count("odometry: none yet; of the scans before it, the last 5 are used"), 1u)
      << events.text();
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["skipped_readings"], 15);
  EXPECT_EQ(entriesOf(recording()), log.size());
  replayRecording();
  expectSameResults();
  EXPECT_EQ(nlohmann::json::parse(result("offline/metrics.json"))["skipped_readings"], 15);
}

TEST_F(LiveRunTest, OdometryThatIsNoNumberIsRecorded) {
  options.maxWaiting = 1000;
  test::Log log = test::laps(10);
  log.insert(log.begin() + 10, test::odometry(1001, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  runLive(log);
  EXPECT_EQ(entriesOf(recording()), log.size());
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["skipped_readings"], 1);
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
  EXPECT_EQ(entriesOf(recording()), log.size()) << "also the odometry";
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
  run.finish(7);
  const auto metrics = nlohmann::json::parse(result("live/metrics.json"));
  EXPECT_EQ(metrics["lost_cycles"], 7);
  EXPECT_EQ(events.count("without 7 cycles of the server that did not arrive"), 1u);
  EXPECT_EQ(metrics["scans"].get<size_t>() + metrics["skipped"].get<size_t>(), kScans);
  EXPECT_GT(metrics["skipped"], 0);
  EXPECT_NEAR(metrics["distance_m"].get<double>(), 0.01 * (kScans - 1), 1e-6);
  EXPECT_GE(events.count("late: "), 1u);
  replayRecording();
  EXPECT_EQ(nlohmann::json::parse(result("offline/metrics.json"))["scans"], kScans)
      << "the recording has all";
}

// Otherwise a run with a long queue has no results for minutes after Ctrl-C.
TEST_F(LiveRunTest, TheResultsWaitForTheQueueAsLongAsTheyMay) {
  options.maxWaiting = 1000;
  run::Configuration c = configuration("live");
  LiveRun run(c, options, events.log(), true);
  run.setWatcher([](const FilterView&, const readings::Reading&, bool) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  });
  CycleGrouper grouper(0, [&](const CSensoryFrame::Ptr& cycle) { run.take(cycle); });
  for (const auto& object : test::laps(50))
    grouper.add(std::dynamic_pointer_cast<mrpt::obs::CObservation>(object));
  grouper.finish();
  run.finish(0, 0.1);
  const auto metrics = nlohmann::json::parse(result("live/metrics.json"));
  EXPECT_GT(metrics["skipped"], 10);
  EXPECT_EQ(metrics["scans"].get<size_t>() + metrics["skipped"].get<size_t>(), 50u);
  EXPECT_NEAR(files::loadTum(folder.path("live/trajectory.tum")).back().timestamp, 1000 + 0.2 * 49, 1e-6);
}

TEST_F(LiveRunTest, AFilterThatIsAlwaysLateDoesNotFloodTheLog) {
  options.maxWaiting = 1;
  run::Configuration c = configuration("live");
  LiveRun run(c, options, events.log(), true);
  std::atomic<size_t> sent{0}, filtered{0};
  run.setWatcher([&](const FilterView&, const readings::Reading&, bool) {
    ++filtered;
    const size_t before = sent;
    test::happens([&] { return sent >= std::min<size_t>(before + 3, 300); });
  });
  for (size_t i = 0; i < 300; ++i) {
    const double time = 1000 + 0.2 * static_cast<double>(i);
    const auto cycle = CSensoryFrame::Create();
    cycle->insert(test::odometry(time, {}));
    cycle->insert(test::scan(time));
    run.take(cycle);
    ++sent;
    if (i % 8 == 7) test::happens([&] { return filtered >= i / 8; });  // however slow the machine is
  }
  run.finish(0);
  EXPECT_GT(filtered, 10u) << "each late";
  EXPECT_GE(events.count("late: "), 1u);
  EXPECT_LE(events.count("late: "), 9u) << events.text();
}

TEST_F(LiveRunTest, TellsWhenTheMapIsLost) {
  options.maxWaiting = 1000, stateInterval = 0;
  runLive(test::lapsWithMirroredOdometry(240));
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["verdict"], "lost");
  EXPECT_GT(events.count("map: verdict: lost: "), 0u) << events.text();
}

TEST_F(LiveRunTest, SaysNothingOfAGoodMap) {
  options.maxWaiting = 1000, stateInterval = 0;
  const test::Log log = test::laps(240);
  test::addNoise(log);
  runLive(log);
  EXPECT_EQ(nlohmann::json::parse(result("live/metrics.json"))["verdict"], "consistent");
  EXPECT_EQ(events.count("map: verdict"), 0u) << events.text();
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
  EXPECT_EQ(events.count("jumps by over 100 m or far above the robot's speed"), 1u) << events.text();
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

TEST_F(LiveRunTest, WrongRecordingNames) {
  run::Configuration c = configuration("live");
  for (const char* name : {"", "a/b.rawlog"}) {
    options.recording = name;
    EXPECT_THROW(LiveRun(c, options, events.log(), true), InputError) << name;
  }
}

}  // namespace
}  // namespace hybrid_slam::live
