// The project's claim: with line directions in the weight, few particles close a loop that the same filter
// without lines does not close. Both have their best settings (scripts/search-settings.sh).

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "files/TemporaryFolder.h"
#include "study/evaluation/AbsoluteTrajectoryError.h"
#include "study/evaluation/RelationErrors.h"

namespace hybrid_slam {
namespace {

constexpr int kSeeds = 6;
const std::string kLines = "-m hybrid";
const std::string kNoLines =
    "-m general --set grid_weight.exponent=120 --set grid_weight.sigma=0.2 --set grid_weight.beams=90";
const std::string kEqNine = "-m hybrid --set line_weight.method=paper";

class Claim : public testing::Test {
 protected:
  files::Trajectory run(const std::string& ini, const std::string& log, const std::string& options,
                        int seed) {
    const std::string command = std::string("'") + HYBRID_SLAM + "' '" SOURCE_DIR "/config-ini/" + ini +
                                "' '" + log + "' -q --overwrite -p standard -n 20 -s " +
                                std::to_string(seed) + " -o '" + folder_.path("out") + "' " + options;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return files::loadTum(folder_.path("out/trajectory.tum"));
  }

  /// Root of the mean square error of the positions on the simulated CSIE loop, m, for seeds 1 to kSeeds.
  std::vector<double> onTheLoop(const std::string& options) {
    const std::string loop = SOURCE_DIR "/datasets/csie/csie-loop";
    const files::Trajectory truth = files::loadTum(loop + ".tum");
    std::vector<double> errors;
    for (int seed = 1; seed <= kSeeds; ++seed)
      errors.push_back(evaluation::absoluteTrajectoryError(
                           run("csie-lms100.ini", loop + ".rawlog", options, seed), truth, 0.02)
                           .translation.rmse);
    return errors;
  }

  files::TemporaryFolder folder_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Number of seeds for which the first is smaller.
int wins(const std::vector<double>& a, const std::vector<double>& b) {
  int count = 0;
  for (size_t i = 0; i < a.size(); ++i) count += a[i] < b[i];
  return count;
}

TEST_F(Claim, LinesAndEqNineAsPrintedBeatNoLinesOnTheSimulatedLoop) {
  const auto noLines = onTheLoop(kNoLines), lines = onTheLoop(kLines);
  EXPECT_LT(*std::max_element(lines.begin(), lines.end()), 0.2);
  for (const auto& errors : {lines, onTheLoop(kEqNine)}) {
    EXPECT_LT(median(errors), 0.5 * median(noLines));
    EXPECT_GE(wins(errors, noLines), kSeeds - 1);
  }
}

/// MIT Killian Court, 1.9 km: every run without lines fails.
TEST_F(Claim, LinesBeatNoLinesOnKillianCourt) {
  const char* const datasets = std::getenv("HYBRID_SLAM_DATASETS");
  if (!datasets) GTEST_SKIP() << "HYBRID_SLAM_DATASETS is unset";
  const std::string log = std::string(datasets) + "/mit-killian", rawlog = folder_.path("killian.rawlog");
  const std::string convert =
      std::string("'") + LOG2RAWLOG + "' '" + log + ".clf.gz' '" + rawlog + "' >/dev/null 2>&1";
  ASSERT_EQ(std::system(convert.c_str()), 0) << convert;
  const auto relations = evaluation::loadRelations(log + ".relations");
  const files::Trajectory odometry = files::loadOdometry(log + ".odom.gz");
  const auto errorOf = [&](const std::string& options, int seed) {
    return evaluation::evaluateRelations(run("paper.ini", rawlog, options, seed), relations, &odometry, 0.006)
        .translation.mean;
  };
  std::vector<double> lines, noLines;
  for (int seed = 1; seed <= 3; ++seed) {
    lines.push_back(errorOf(kLines, seed));
    noLines.push_back(errorOf(kNoLines, seed));
  }
  EXPECT_LT(median(lines), 0.3);
  EXPECT_LT(median(lines), 0.2 * median(noLines));
  EXPECT_EQ(wins(lines, noLines), 3);
}

}  // namespace
}  // namespace hybrid_slam
