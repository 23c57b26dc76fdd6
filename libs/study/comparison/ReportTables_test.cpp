#include "study/comparison/ReportTables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hybrid_slam::comparison {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::vector<Group> kOneGroup{{"general", {}, 20}};
const std::vector<Figure> kErrors{Figure::ate};

/// Four runs with ATEs of 1, 2, 3 and 4 m, and one that failed.
std::vector<RunResult> runs(int successes) {
  std::vector<RunResult> all(5);
  for (int seed = 1; seed <= 5; ++seed) {
    RunResult& r = all[static_cast<size_t>(seed) - 1];
    r.run = {0, seed};
    r.status = seed < 5 ? RunResult::Status::done : RunResult::Status::failed;
    if (seed == 5) continue;
    r[Figure::ate] = seed;
    r[Figure::success] = seed <= successes;
  }
  return all;
}

std::string table(const std::vector<RunResult>& results, bool withSuccess = true) {
  return summaryTable(kOneGroup, groupSummaries(1, results), kErrors, withSuccess);
}

TEST(SummaryTable, SuccessIsCountedFirst) {
  EXPECT_THAT(table(runs(2)), HasSubstr("<th>particles</th><th>success</th><th>runs</th>"));
  EXPECT_THAT(table(runs(2)), HasSubstr("<td>2&#160;of&#160;5 <small>11.8&#160;&#8211;&#160;76.9&#160;%"));
}

TEST(SummaryTable, AGroupWithBothOutcomesShowsItsSuccessesFirst) {
  EXPECT_THAT(table(runs(2)), HasSubstr("<td>1.5 <small>of 2 successes</small> <small>all 2.5</small> "
                                        "<small>1.75&#160;&#8211;&#160;3.25</small></td>"));
  EXPECT_THAT(table(runs(1)), HasSubstr("<td>1 <small>of 1 success</small>"));
}

TEST(SummaryTable, AGroupWithOneOutcomeHasOneMedian) {
  const std::string median = "<td>2.5 <small>1.75&#160;&#8211;&#160;3.25</small></td>";
  EXPECT_THAT(table(runs(0)), HasSubstr(median));
  EXPECT_THAT(table(runs(2), false), HasSubstr(median));
  auto all = runs(4);
  all.pop_back();  // the failed one
  EXPECT_THAT(table(all), HasSubstr(median));
  for (RunResult& r : all) r[Figure::success].reset();
  EXPECT_THAT(table(all), HasSubstr(median));
  EXPECT_THAT(table(all), Not(HasSubstr("success")));
}

TEST(PairedTable, HasTheRatiosOfTheMedians) {
  const std::vector<Group> groups{{"hybrid", {}, 20}, {"general", {}, 20}};
  std::vector<RunResult> results;
  for (size_t g = 0; g < 2; ++g)
    for (RunResult r : runs(4)) {
      r.run.group = g;
      if (r[Figure::ate]) *r[Figure::ate] *= g == 0 ? 1 : 3;
      results.push_back(r);
    }
  const std::string paired = pairedTable(groups, groupSummaries(2, results));
  EXPECT_THAT(paired, HasSubstr("<td>general-20</td><td>4</td>"));
  EXPECT_THAT(paired, HasSubstr("<td>3 <small>"));
  EXPECT_EQ(pairedTable(kOneGroup, groupSummaries(1, runs(4))), "");
}

TEST(FailureTable, NamesTheErrors) {
  auto all = runs(4);
  all[4].error = "a < b";
  EXPECT_THAT(failureTable(kOneGroup, all), HasSubstr("a &lt; b"));
  all.pop_back();
  EXPECT_EQ(failureTable(kOneGroup, all), "");
}

}  // namespace
}  // namespace hybrid_slam::comparison
