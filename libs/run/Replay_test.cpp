#include "run/Replay.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "files/TemporaryFolder.h"
#include "run/MotionModelText.h"
#include "testing/CommaLocale.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

/// The text results, without the step times.
std::map<std::string, std::string> resultsOf(const files::TemporaryFolder& folder, const std::string& ini,
                                             const std::string& log) {
  Configuration c(ini, {"run.rawlog=" + log, "run.output=" + folder.path("out"), "run.particles_every=10",
                        "motion_model.distance_var_d=0.0025"});
  c.run.overwrite = true;
  const std::atomic<bool> stop{false};
  replay(c, true, stop, "test");
  std::map<std::string, std::string> texts;
  for (const char* name : {"trajectory.tum", "map.yaml", "lines.csv", "particles.csv", "config.ini"})
    texts[name] = test::contentOf(folder.path(std::string("out/") + name));
  const std::regex stepTime(",[^,\n]*((,[^,\n]*){5}\n)");
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

}  // namespace
}  // namespace hybrid_slam::run
