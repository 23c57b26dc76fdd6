#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/ErrorOf.h"
#include "testing/FilterRunTest.h"

namespace hybrid_slam::run {
namespace {

/// Runs that replace the results of another one only if they are at least as good.
class RepeatedRun : public test::FilterRunTest {
 protected:
  RepeatedRun() {
    makePlain();
    before_ = result("plain/metrics.json");
  }
  void TearDown() override { EXPECT_EQ(result("plain/metrics.json"), before_); }
  /// Repeats it. @return the error with which `finish` refuses to replace the results
  template <class Error>
  std::string refusal(const Verdict& worst, const std::string& file, const std::string& summarised) {
    Configuration c = configuration("plain");
    c.run.overwrite = true;
    FilterRun run(c);
    process(run, c);
    run.expectVerdict(worst);
    const readings::RawlogSummary summary = readings::summarise(summarised, c.input);
    return test::errorOf<Error>([&] { run.finish(file, summary, nlohmann::ordered_json::object()); });
  }

 private:
  std::string before_;
};

TEST_F(RepeatedRun, DoesNotReplaceABetterMap) {
  const std::string cut = test::writeGzipped(folder.path("recording.rawlog"), test::laps(10));  // doubtful
  Verdict worst;
  EXPECT_EQ(refusal<WorseMap>(worst, cut, cut), "its map is doubtful");
  worst.level = Verdict::Level::doubtful, worst.contradiction = -1;
  EXPECT_EQ(refusal<WorseMap>(worst, cut, cut), "its map is doubtful, too, and more scans contradict it");
}

/// Without the log there is no map.simplemap.gz, and no scan that could contradict the map.
TEST_F(RepeatedRun, DoesNotReplaceCompleteResultsByIncompleteOnes) {
  Verdict lost;
  lost.level = Verdict::Level::lost, lost.isContradicted = true, lost.contradiction = 1;
  EXPECT_THAT(refusal<std::runtime_error>(lost, folder.path("gone.rawlog"), log),
              testing::StartsWith("results are missing: "));
  const std::string other = test::writeGzipped(folder.path("other.rawlog"), test::laps(100));
  EXPECT_EQ(refusal<std::runtime_error>(lost, other, log), "the log has changed");
}

}  // namespace
}  // namespace hybrid_slam::run
