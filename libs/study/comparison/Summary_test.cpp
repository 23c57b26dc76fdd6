#include "study/comparison/Summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace hybrid_slam::comparison {
namespace {

using Status = RunResult::Status;
using testing::HasSubstr;

RunResult done(size_t group, int seed, double ate, bool success) {
  RunResult r;
  r.run = {group, seed};
  r.status = Status::done;
  r[Figure::ate] = ate;
  r[Figure::cpuTime] = 10 * ate;
  r[Figure::success] = success;
  return r;
}

RunResult ended(size_t group, int seed, Status status) {
  RunResult r;
  r.run = {group, seed};
  r.status = status;
  return r;
}

const std::vector<Group> kGroups{
    {"general", {}, 20}, {"hybrid", {"eq9", "", "", {"a.b=c"}}, 20}, {"stock", {}, 20}};

/// general: errors 1, 2, 3, 4 and a failed run; hybrid-eq9: half of each error, one run missing; stock: only
/// failed runs.
std::vector<RunResult> results() {
  return {done(0, 1, 1, false), done(0, 2, 2, false),        done(0, 3, 3, true),
          done(0, 4, 4, false), ended(0, 5, Status::failed), done(1, 1, 0.5, true),
          done(1, 2, 1, true),  done(1, 3, 1.5, true),       ended(1, 4, Status::missing),
          done(1, 5, 9, true),  ended(2, 1, Status::failed), ended(2, 2, Status::failed)};
}

constexpr auto kAte = static_cast<size_t>(Figure::ate);

TEST(Summary, GroupsByHand) {
  const auto s = groupSummaries(3, results());
  EXPECT_EQ(s[0].done, 4u);
  EXPECT_EQ(s[0].failed, 1u);
  EXPECT_EQ(s[0].figures[kAte].runs, 4u);
  EXPECT_DOUBLE_EQ(s[0].figures[kAte].quartiles->median, 2.5);
  EXPECT_DOUBLE_EQ(s[0].figures[kAte].quartiles->lower, 1.75);
  EXPECT_FALSE(s[0].paired[kAte]);
  EXPECT_FALSE(s[0].figures[static_cast<size_t>(Figure::rotMean)].quartiles);
}

TEST(Summary, AFailedRunIsNotASuccessAndAMissingOneIsNotCounted) {
  const auto s = groupSummaries(3, results());
  EXPECT_EQ(s[0].successes, 1u);
  EXPECT_DOUBLE_EQ(s[0].successRate, 1.0 / 5);
  EXPECT_EQ(s[1].successes, 4u);
  EXPECT_DOUBLE_EQ(s[1].successRate, 1);
  EXPECT_EQ(s[2].successes, 0u);
  EXPECT_EQ(s[2].ended(), 2u);
  EXPECT_DOUBLE_EQ(s[1].successInterval.low, wilsonInterval(4, 4).low);
  // Seeds 1, 2 and 5 succeed with hybrid-eq9 only, seed 3 with both.
  EXPECT_NEAR(s[1].successSignP, 2.0 / 8, 1e-12);
}

TEST(Summary, SuccessfulRunsHaveAMedianOfTheirOwn) {
  auto runs = results();
  runs[3][Figure::success] = 1;  // general: 3 and 4 of 1, 2, 3, 4
  const auto s = groupSummaries(3, runs);
  EXPECT_EQ(s[0].figures[kAte].successfulRuns, 2u);
  EXPECT_DOUBLE_EQ(*s[0].figures[kAte].successfulMedian, 3.5);
  EXPECT_DOUBLE_EQ(s[0].figures[kAte].quartiles->median, 2.5);
  EXPECT_TRUE(s[0].hasSuccessesAndFailures());
  EXPECT_EQ(s[1].figures[kAte].successfulMedian, s[1].figures[kAte].quartiles->median);
  EXPECT_FALSE(s[1].hasSuccessesAndFailures());
  EXPECT_FALSE(s[2].hasSuccessesAndFailures());
  EXPECT_FALSE(s[0].figures[static_cast<size_t>(Figure::cpuTime)].successfulMedian);  // no error
}

TEST(Summary, PairsAreTheCommonSeeds) {
  const auto s = groupSummaries(3, results());
  ASSERT_TRUE(s[1].paired[kAte]);
  const PairedComparison& p = *s[1].paired[kAte];
  EXPECT_EQ(p.pairs, 3u);  // without the seeds that failed in one group or are missing in the other
  ASSERT_TRUE(p.ratio);
  EXPECT_DOUBLE_EQ(p.ratio->ratio, 0.5);
  EXPECT_DOUBLE_EQ(p.wilcoxonP, 2.0 / 8);
  EXPECT_DOUBLE_EQ(p.signP, 2.0 / 8);
  EXPECT_FALSE(s[1].paired[static_cast<size_t>(Figure::cpuTime)]);
  EXPECT_FALSE(s[2].paired[kAte]);
}

TEST(Summary, WithoutACriterionThereIsNoSuccess) {
  RunResult r = done(0, 1, 1, false);
  r[Figure::success].reset();
  EXPECT_FALSE(groupSummaries(1, {r})[0].successes);
}

TEST(Summary, TablesHaveTheirColumnsInEveryRow) {
  const auto s = groupSummaries(3, results());
  std::ostringstream summaryText, resultText;
  writeSummary(kGroups, s, summaryText);
  writeResults(kGroups, results(), resultText);
  for (const std::string& table : {summaryText.str(), resultText.str()}) {
    std::istringstream lines(table);
    std::string header, line;
    std::getline(lines, header);
    const auto columns = std::count(header.begin(), header.end(), ',');
    size_t rows = 0;
    while (std::getline(lines, line)) {
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
      ++rows;
    }
    EXPECT_GE(rows, 5u);
  }
  EXPECT_THAT(summaryText.str(), HasSubstr("\nhybrid,eq9,20,4,0,4,1,"));
  EXPECT_THAT(summaryText.str(), HasSubstr("\nstock,,20,0,2,0,0,0,"));  // a row also without figures
  EXPECT_THAT(summaryText.str(), HasSubstr("sign_p,successful_runs,successful_median\n"));
  EXPECT_THAT(summaryText.str(), HasSubstr(",ate_rmse_m,4,1.75,2.5,3.25,,,,,,,1,3\n"));
  EXPECT_THAT(resultText.str(),
              HasSubstr("method,variant,particles,seed,status,trans_mean_m,rot_mean_deg,ate_rmse_m,"
                        "return_trans_m,return_rot_deg,wall_mean_m,wall_p95_m,doubled_share,"
                        "success,wall_s,cpu_s,peak_rss_mb,realtime_factor,lines,std_along_m,std_across_m,"
                        "std_phi_deg,revisit_median_m,revisits\n"));
  EXPECT_THAT(resultText.str(), HasSubstr("\ngeneral,,20,3,done,,,3,,,,,,1,,30,"));
  EXPECT_THAT(resultText.str(), HasSubstr("\nstock,,20,2,failed,,"));
}

TEST(Summary, JsonHasTheSameContent) {
  const auto json = summaryJson(kGroups, groupSummaries(3, results()));
  ASSERT_EQ(json.at("groups").size(), 3u);
  const auto& group = json["groups"][1];
  EXPECT_EQ(group.at("group"), "hybrid-eq9-20");
  EXPECT_EQ(group.at("settings")[0], "a.b=c");
  EXPECT_EQ(group.at("success").at("successes"), 4);
  const auto& against = group.at("figures").at("ate_rmse_m").at("against_first");
  EXPECT_EQ(against.at("group"), "general-20");
  EXPECT_EQ(against.at("median_ratio"), 0.5);
  EXPECT_EQ(against.at("wilcoxon_p"), 0.25);
  const auto& successful = json["groups"][0].at("figures").at("ate_rmse_m").at("successful");
  EXPECT_EQ(successful.at("runs"), 1);
  EXPECT_EQ(successful.at("median"), 3);
  EXPECT_FALSE(json["groups"][2].contains("figures"));
}

}  // namespace
}  // namespace hybrid_slam::comparison
