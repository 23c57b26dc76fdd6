/// @file LiveRunTest.h
/// @brief For the tests: live runs of short logs, and replays of their recordings.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>

#include "files/RawlogReader.h"
#include "files/TemporaryFolder.h"
#include "live/CycleGrouper.h"
#include "live_run/LiveRun.h"
#include "run/Replay.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

class LiveRunTest : public ::testing::Test {
 protected:
  LiveRunTest() { options.diskReserve = 0; }  // the tests' disk may be small
  run::Configuration configuration(const std::string& output, const std::string& more = "") {
    const std::string ini =
        folder.write("run.ini",
                     "[particle_filter]\nparticles = 5\nproposal = standard\nupdate_distance = 0.2\n[grid]\n"
                     "resolution = 0.1\n" +
                         more);
    return run::Configuration(ini, {"run.output=" + folder.path(output)});
  }
  /// Passes the log's observations through a grouper to a live run. @return the summary
  std::string runLive(const Log& log, const std::string& more = "") {
    run::Configuration c = configuration("live", more);
    live::LiveRun run(c, options, events.log(), true);
    run.setStateInterval(stateInterval);
    live::CycleGrouper grouper(0, [&](const mrpt::obs::CSensoryFrame::Ptr& cycle) { run.take(cycle); });
    for (const auto& object : log) grouper.add(std::dynamic_pointer_cast<mrpt::obs::CObservation>(object));
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
    const auto all = filesIn(folder.path("live"), "recording-");
    return all.empty() ? "" : all.back();
  }
  /// Returns the number of entries of a complete rawlog.
  static size_t entriesOf(const std::string& rawlog) {
    files::RawlogReader reader(rawlog);
    size_t objects = 0;
    while (reader.next()) ++objects;
    EXPECT_EQ(reader.defect(), "");
    return objects;
  }
  std::string result(const std::string& name) const { return contentOf(folder.path(name)); }
  void expectSameResults() {
    for (const char* name : {"trajectory.tum", "map.pgm", "map.yaml", "lines.csv"}) {
      EXPECT_EQ(result(std::string("live/") + name), result(std::string("offline/") + name)) << name;
      EXPECT_FALSE(result(std::string("live/") + name).empty()) << name;
    }
    EXPECT_EQ(result("live/map.simplemap.gz"), result("offline/map.simplemap.gz"));
  }

  files::TemporaryFolder folder;
  Events events;
  live::LiveOptions options;
  double stateInterval = 10;  // s
};

}  // namespace hybrid_slam::test
