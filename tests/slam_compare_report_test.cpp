/// report.html of slam-compare: its tables and plots, with and without true poses and gnuplot.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "SlamCompareProgram.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

struct SlamCompareReport : SlamCompare {};

TEST_F(SlamCompareReport, TheReportIsOneWellFormedFileWithItsPlots) {
  ASSERT_EQ(run(kSmall + kTruth).status, 0);
  const std::string report = this->report();
  for (const char* part :
       {"--methods hybrid,general --particles 4 --seeds 2", "Success rates",
        "absolute trajectory error, rmse (m)", "heading error at the return (deg)", "share of doubled wall",
        "Each group against the first", "spread of the heading (deg)", "CPU time (s)", "peak memory (MB)",
        "trajectories of general-4", "median run", "worst run", "data:image/png;base64,iVBORw0KGgo"})
    EXPECT_THAT(report, HasSubstr(part));
  EXPECT_THAT(report, Not(HasSubstr("<script")));
  const std::regex address("(src|href)=\"(?!data:)");
  EXPECT_FALSE(std::regex_search(report, address));
}

TEST_F(SlamCompareReport, TheReportOf12RunsIsSmallAndReproducible) {
  const std::string sweep =
      "--methods hybrid,general -n 3,5 --seeds 3 -q --set run.particles_every=2" + kTruth;
  ASSERT_EQ(run(sweep).status, 0);
  const std::string report = this->report();
  EXPECT_LT(report.size(), 1500000u);
  for (const char* plot : {"success rates",
                           "absolute trajectory error, rmse (m)",
                           "position error at the return (m)",
                           "heading error at the return (deg)",
                           "distance of occupied cells to the walls: mean (m)",
                           "distance of occupied cells to the walls: 95th percentile (m)",
                           "share of doubled wall",
                           "spread along the heading (m)",
                           "spread across the heading (m)",
                           "spread of the heading (deg)",
                           "spread in x (m)",
                           "spread in y (m)",
                           "particles of hybrid-3, ",
                           "particles of general-5, ",
                           "CPU time (s) against particles",
                           "peak memory (MB) against particles",
                           "trajectories of hybrid-5",
                           "trajectories of general-3",
                           "occupied cells over the walls, hybrid-3: mean ",
                           "occupied cells over the walls, general-5: mean "})
    EXPECT_THAT(report, HasSubstr("aria-label=\"" + std::string(plot)));
  EXPECT_THAT(report, Not(HasSubstr("Without plots")));
  ASSERT_EQ(run(sweep + " --report-only").status, 0);
  // The same except for the command.
  const auto body = [](const std::string& html) { return html.substr(html.find("</pre>")); };
  EXPECT_EQ(body(this->report()), body(report));
}

TEST_F(SlamCompareReport, WithoutGnuplotTheReportHasItsTables) {
  ASSERT_EQ(run(kSmall + kTruth).status, 0);
  const std::string before = test::contentOf(folder.path("out/results.csv"));
  const Outcome o = shell("PATH=/nowhere " + call(kSmall + kTruth + " --report-only"));
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err,
            "slam-compare: warning: report.html without plots: gnuplot: cannot be started: No such file or "
            "directory; expected the Debian package gnuplot-nox\n");
  EXPECT_EQ(test::contentOf(folder.path("out/results.csv")), before);
  EXPECT_TRUE(fs::exists(folder.path("out/summary.json")));
  const std::string report = this->report();
  EXPECT_THAT(report, HasSubstr("Each group against the first"));
  EXPECT_THAT(report, HasSubstr("data:image/png;base64,iVBORw0KGgo"));  // the maps
  EXPECT_THAT(report, HasSubstr("Without plots: gnuplot: cannot be started"));
  EXPECT_THAT(report, Not(HasSubstr("<svg")));
}

TEST_F(SlamCompareReport, WithoutTruthItReportsSpreadTimeAndMemory) {
  const Outcome o = run("--methods general --seeds 2 -q");  // particles from the INI file
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(runs(), UnorderedElementsAre("general-3-1", "general-3-2"));
  for (const auto& row : table("results.csv")) {
    EXPECT_EQ(row.at("ate_rmse_m"), "");
    EXPECT_EQ(row.at("success"), "");
    EXPECT_GT(std::stod(row.at("std_phi_deg")), 0);
  }
  const std::string report = this->report();
  EXPECT_THAT(report, Not(HasSubstr("Success rates")));
}

}  // namespace
}  // namespace hybrid_slam
