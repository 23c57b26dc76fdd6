/// @file ReplaySessionTest.h
/// @brief For the tests: replays of short logs, and waiting for their states.
#pragma once

#include <gtest/gtest.h>

#include "files/TemporaryFolder.h"
#include "testing/Happens.h"
#include "testing/TestLogs.h"
#include "window/view/ReplaySession.h"

namespace hybrid_slam::test {

class ReplaySessionTest : public ::testing::Test {
 protected:
  static constexpr size_t kScans = 60;
  run::Configuration configuration(const std::string& log) {
    const std::string ini =
        folder.write("run.ini",
                     "[particle_filter]\nparticles = 5\nproposal = standard\nupdate_distance = 0.2\n[grid]\n"
                     "resolution = 0.1\n");
    return run::Configuration(ini, {"run.rawlog=" + log});
  }
  run::Configuration laps() {
    return configuration(writeGzipped(folder.path("laps.rawlog"), test::laps(kScans)));
  }
  static bool reaches(const window::ReplaySession& session, window::ReplaySnapshot::State state,
                      size_t scans) {
    return happens([&] {
      const auto now = session.snapshot();
      return now->state == state && now->scans == scans;
    });
  }
  files::TemporaryFolder folder;
};

}  // namespace hybrid_slam::test
