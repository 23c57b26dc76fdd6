#include "run/FinishedPath.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "files/NumberTable.h"
#include "files/TemporaryFolder.h"
#include "run/Replay.h"
#include "testing/ErrorOf.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

/// A run of three laps, 29 m, whose third returns to places mapped 20 m before. A single particle has no
/// spread.
struct FinishedPathTest : testing::Test {
  files::TemporaryFolder folder;
  std::string log = test::writeGzipped(folder.path("laps.rawlog"), test::laps(240));

  std::string map(const std::string& method, const std::string& continued = {}) const {
    const std::string output = folder.path(method + (continued.empty() ? "" : "-continued"));
    Configuration configuration("", {"run.rawlog=" + log, "run.output=" + output, "run.method=" + method,
                                     "particle_filter.particles=1"});
    if (!continued.empty()) {
      configuration.run.continueFrom = continued + "/session.hslam";
      configuration.run.start.emplace(0, 0, 0);
    }
    replay(configuration, true, std::atomic<bool>{false});
    return output;
  }

  /// Whether the covariances are those of covariance.csv.
  void expectSame(const std::string& results) const {
    const FinishedPath path = readFinishedPath(results, log);
    const auto ofPoses = path.covariances.ofPoses();
    const auto rows =
        files::readNumberTable(results + "/covariance.csv", "timestamp,xx,xy,yy,xphi,yphi,phiphi");
    ASSERT_EQ(rows.size(), path.trajectory.size());
    size_t compared = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
      if (path.updates[i] == (i > 0 ? path.updates[i - 1] : 0)) continue;
      const auto& v = rows[i].values;
      const PoseCovariance& covariance = ofPoses.at(path.updates[i] - 1);
      const auto expectNear = [&](int row, int column, double value) {
        EXPECT_NEAR(covariance(row, column), value,
                    1e-5 * std::sqrt(covariance(row, row) * covariance(column, column)))
            << results << ", row " << i << ": " << row << ", " << column;
      };
      expectNear(0, 0, v[1]), expectNear(0, 1, v[2]), expectNear(1, 1, v[3]);
      expectNear(0, 2, v[4]), expectNear(1, 2, v[5]), expectNear(2, 2, v[6]);
      ++compared;
    }
    EXPECT_GT(compared, 10u);
  }
};

TEST_F(FinishedPathTest, HasTheCovariancesOfTheRun) {
  for (const char* method : {"hybrid", "general"}) expectSame(map(method));
}

// A run that continues a map does not relax its path.
TEST_F(FinishedPathTest, HasTheCovariancesOfARunThatContinuesAMap) {
  expectSame(map("hybrid", map("hybrid")));
}

TEST_F(FinishedPathTest, MetricsThatDoNotSayWhetherThePathIsRelaxed) {
  const std::string results = map("hybrid");
  for (const char* metrics : {"{", "{}", R"({"path_relaxed": 1})"}) {
    folder.write("hybrid/metrics.json", metrics);
    EXPECT_EQ(
        test::errorOf([&] { readFinishedPath(results, log); }),
        "no key `path_relaxed`: " + results + "/metrics.json; expected the metrics of a run of this version")
        << metrics;
  }
}

TEST_F(FinishedPathTest, TimesThatDoNotTellTheScansApart) {
  test::Log coarse = test::laps(240);
  for (const auto& object : coarse) {
    const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
    observation->timestamp = test::stamp(std::floor(mrpt::Clock::toDouble(observation->timestamp)));
  }
  log = test::writeGzipped(folder.path("coarse.rawlog"), coarse);
  const std::string results = map("hybrid");
  EXPECT_THAT(
      test::errorOf([&] { readFinishedPath(results, log); }),
      testing::MatchesRegex("[0-9]+ updates share the time of another scan: .*/trajectory.tum; expected a "
                            "log whose timestamps tell its scans apart"));
}

TEST_F(FinishedPathTest, FilesThatDoNotBelongTogether) {
  const std::string results = map("hybrid");
  const std::string other = test::writeGzipped(folder.path("other.rawlog"), test::laps(20));
  EXPECT_EQ(test::errorOf([&] { readFinishedPath(results, other); }),
            "the log is not that of the run: " + other + "; expected a scan at each time of " + results +
                "/trajectory.tum");
  EXPECT_THAT(test::errorOf([&] { readFinishedPath(folder.path("none"), log); }),
              testing::HasSubstr(folder.path("none") + "/config.ini"));
  folder.write("hybrid/steps.csv", "timestamp,particles\n1000,2\n7,2\n");
  EXPECT_EQ(test::errorOf([&] { readFinishedPath(results, log); }),
            "the updates are not those of the trajectory: " + results +
                "/steps.csv; expected the files of one run");
  folder.write("hybrid/steps.csv", "timestamp,particles\nnow,2\n");
  EXPECT_EQ(test::errorOf([&] { readFinishedPath(results, log); }),
            "broken line: file `" + results + "/steps.csv`, line 2; expected a row of steps.csv");
  std::filesystem::remove(results + "/steps.csv");
  EXPECT_THAT(test::errorOf([&] { readFinishedPath(results, log); }), testing::HasSubstr("steps.csv"));
}

}  // namespace
}  // namespace hybrid_slam::run
