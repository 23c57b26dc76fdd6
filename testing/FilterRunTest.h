/// @file FilterRunTest.h
/// @brief For the tests: runs over a short log.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "files/TemporaryFolder.h"
#include "run/FilterRun.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

using run::Configuration;
using run::FilterRun;
using run::FinishedRun;

/// Runs over a log of 100 scans.
class FilterRunTest : public testing::Test {
 protected:
  Configuration configuration(const std::string& output, std::vector<std::string> settings = {}) {
    settings.insert(settings.end(), {"run.output=" + folder.path(output), "particle_filter.particles=5",
                                     "particle_filter.proposal=standard"});
    return {"", settings};
  }
  void process(FilterRun& run, const Configuration& c) const {
    readings::RawlogSource source(log, c.input, readings::summarise(log, c.input));
    while (const auto reading = source.next()) run.process(*reading);
  }
  static FinishedRun finish(FilterRun& run, const Configuration& c, const std::string& file) {
    return run.finish(file, readings::summarise(file, c.input), nlohmann::ordered_json::object());
  }
  /// Writes the results of a run that is not refined to `plain`.
  void makePlain() {
    Configuration c = configuration("plain", {"grid.resolution=0.1", "run.refine=0"});
    FilterRun run(c);
    process(run, c);
    finish(run, c, log);
  }
  void expectPlain(const std::string& output) const {
    for (const std::string name : {"/trajectory.tum", "/map.pgm", "/lines.csv", "/plan.geojson"}) {
      EXPECT_EQ(result(output + name), result("plain" + name)) << name;
      EXPECT_NE(result(output + name), "") << name;
    }
  }
  std::string result(const std::string& name) const { return test::contentOf(folder.path(name)); }

  files::TemporaryFolder folder;
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(100));
};

}  // namespace hybrid_slam::test
