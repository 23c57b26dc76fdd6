#include "run/FilteredMotions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

TEST(FilteredMotions, ALogThatHasBecomeShorterSinceItsSummaryIsAnError) {
  const files::TemporaryFolder folder;
  const std::string log = test::writeGzipped(folder.path("log"), test::laps(40));
  const Configuration c("", {"run.rawlog=" + log, "particle_filter.particles=2", "grid.resolution=0.1"});
  const readings::RawlogSummary summary = readings::summarise(log, c.input);
  const std::atomic<bool> stop{false};
  EXPECT_FALSE(filteredMotions(c, summary, true, "", stop).samples.empty());
  test::writeGzipped(log, test::laps(30));
  EXPECT_THAT(test::errorOf([&] { filteredMotions(c, summary, true, "", stop); }),
              testing::MatchesRegex("log has become shorter while it was read: .*; expected 40 scans"));
}

TEST(FilteredMotions, ALogThatHasChangedSinceItsSummaryIsAnError) {
  const files::TemporaryFolder folder;
  const std::string log = test::writeGzipped(folder.path("log"), test::laps(40));
  const Configuration c("", {"run.rawlog=" + log, "particle_filter.particles=2", "grid.resolution=0.1"});
  const readings::RawlogSummary summary = readings::summarise(log, c.input);
  test::writeGzipped(log, test::laps(41));
  const std::atomic<bool> stop{false};
  EXPECT_THAT(test::errorOf([&] { filteredMotions(c, summary, true, "", stop); }),
              testing::StartsWith("log has changed while it was read: " + log));
}

TEST(FilteredMotions, FiltersWithoutWeightedMotionsAreRejected) {
  for (const char* method : {"stock", "ortho"}) {
    const Configuration c("", {"run.method=" + std::string(method)});
    const std::atomic<bool> stop{false};
    EXPECT_EQ(test::errorOf([&] { filteredMotions(c, {}, true, "", stop); }),
              "filter not suited for learning: section [run], key `method`; expected hybrid or general");
  }
}

}  // namespace
}  // namespace hybrid_slam::run
