/// slam-compare from the command line: a complete comparison, interruption and resumption, failing runs, all
/// kinds of invalid input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "ChildProgram.h"
#include "InstalledProgram.h"
#include "SlamCompareProgram.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAre;

TEST_F(SlamCompare, HelpAndVersion) {
  const Outcome help = shell(std::string("'") + SLAM_COMPARE + "' --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out, HasSubstr("Usage: slam-compare"));
  const Outcome version = shell(std::string("'") + SLAM_COMPARE + "' --version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "slam-compare " HYBRID_SLAM_VERSION "\n");
}

TEST_F(SlamCompare, ACompleteComparison) {
  const Outcome o = run(kSmall + " --variant hybrid/eq9:line_weight.method=paper" + kTruth);
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_THAT(runs(), UnorderedElementsAre("hybrid-4-1", "hybrid-4-2", "hybrid-eq9-4-1", "hybrid-eq9-4-2",
                                           "general-4-1", "general-4-2"));
  const fs::path one = folder.path("out/runs/hybrid-eq9-4-2");
  for (const char* name : {"metrics.json", "config.ini", "trajectory.tum", "steps.csv", "lines.csv",
                           "map.png", "map.gridmap.gz", "origin.json"})
    EXPECT_TRUE(fs::exists(one / name)) << name;
  for (const char* name : {"map.simplemap.gz", "map.pgm", "map.yaml"})
    EXPECT_FALSE(fs::exists(one / name)) << name;
  EXPECT_THAT(test::contentOf(one / "config.ini"), HasSubstr("seed = 2"));
  EXPECT_THAT(test::contentOf(one / "config.ini"), HasSubstr("method = paper"));

  const auto rows = table("results.csv");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[2].at("variant"), "eq9");
  EXPECT_EQ(rows[5].at("method"), "general");
  EXPECT_EQ(rows[5].at("lines"), "0");
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("status"), "done");
    EXPECT_EQ(row.at("particles"), "4");
    EXPECT_EQ(row.at("trans_mean_m"), "");  // no relations
    EXPECT_GT(std::stod(row.at("ate_rmse_m")), 0);
    EXPECT_LT(std::stod(row.at("ate_rmse_m")), 3);
    EXPECT_GT(std::stod(row.at("wall_mean_m")), 0);
    EXPECT_GE(std::stod(row.at("doubled_share")), 0);
    EXPECT_GT(std::stod(row.at("peak_rss_mb")), 1);
    EXPECT_THAT((std::vector<std::string>{"0", "1"}), testing::Contains(row.at("success")));
  }
  const auto json = nlohmann::json::parse(test::contentOf(folder.path("out/summary.json")));
  EXPECT_EQ(json.at("groups").size(), 3u);
  EXPECT_GT(table("summary.csv").size(), 20u);
}

TEST_F(SlamCompare, LineMapsAndRightAnglesAreMethodsLikeTheOthers) {
  const Outcome o = run("--methods hybrid,linemap,ortho --particles 3 --seeds 1 -q" + kTruth);
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_THAT(runs(), UnorderedElementsAre("hybrid-3-1", "linemap-3-1", "ortho-3-1"));
  const auto rows = table("results.csv");
  ASSERT_EQ(rows.size(), 3u);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("status"), "done");
    EXPECT_GT(std::stod(row.at("ate_rmse_m")), 0);
    EXPECT_GT(std::stod(row.at("wall_mean_m")), 0);
    EXPECT_GT(std::stoi(row.at("lines")), 0);
  }
  EXPECT_THAT(report(), testing::AllOf(HasSubstr("trajectories of linemap-3"), HasSubstr("ortho-3")));
}

TEST_F(SlamCompare, AnIgnoredLaserIsAWarning) {
  test::Log log = test::laps(10);
  for (int i = 0; i < 10; ++i) {
    const auto tilted = test::scan(1000.1 + 0.2 * i, {}, 181, "TILTED");
    tilted->sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0.5, 0);
    log.push_back(tilted);
  }
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  const Outcome o = shell("'" SLAM_COMPARE "' '" + path + "' -o out -n 3 --seeds 1 --list");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("slam-compare: warning: laser `TILTED` is not used: "));
}

TEST_F(SlamCompare, TheTruthMayBeInstalledFiles) {
  const test::InstalledProgram installed(folder, SLAM_COMPARE);
  fs::copy_file(kCsie + "csie-corridor.tum", installed.data("truth.tum"));
  fs::copy_file(kCsie + "csie.plan", installed.data("building.plan"));
  std::ofstream(installed.data("relations")) << "1 2 1 0 0 0 0 0\n";
  std::ofstream(installed.data("text")) << "text\n";
  const auto list = [&](const std::string& truth) {
    return shell("'" + installed.path + "' " + kLog + " -o out --list --seeds 1 " + truth);
  };
  const Outcome o = list("--reference data/truth.tum --floorplan data/building.plan");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(errorLine(list("--relations data/text")), HasSubstr(installed.data("text")));
  EXPECT_THAT(errorLine(list("--relations data/relations --odometry data/text")),
              HasSubstr(installed.data("text")));
  EXPECT_THAT(errorLine(list("--reference data/none.tum")), HasSubstr("file `data/none.tum`;"));
}

TEST_F(SlamCompare, TheReportIsOneWellFormedFileWithItsPlots) {
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

TEST_F(SlamCompare, TheReportOf24RunsIsSmallAndReproducible) {
  const std::string sweep =
      "--methods hybrid,general -n 3,5 --seeds 6 -q --set run.particles_every=2" + kTruth;
  ASSERT_EQ(run(sweep).status, 0);
  const std::string report = this->report();
  EXPECT_LT(report.size(), 2000000u);
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

TEST_F(SlamCompare, WithoutGnuplotTheReportHasItsTables) {
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

TEST_F(SlamCompare, WithoutTruthItReportsSpreadTimeAndMemory) {
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

TEST_F(SlamCompare, ParticlesArePlottedIfTheRunsHaveThem) {
  ASSERT_EQ(run(kSmall + kTruth + " --set run.particles_every=2").status, 0);
  const std::string report = this->report();
  EXPECT_THAT(report, HasSubstr("particles of hybrid-4, "));
  EXPECT_THAT(report, HasSubstr("particles of general-4, "));
}

TEST_F(SlamCompare, InterruptedAndResumedGivesTheSameTable) {
  ASSERT_EQ(run(kSmall + kTruth).status, 0);
  const std::string whole = untimedTable();
  fs::remove_all(folder.path("out"));

  test::ChildProgram stopped(
      folder, "stopped",
      {"/bin/sh", "-c", "cd '" + folder.path("") + "' && exec " + call(kSmall + kTruth + " -j 1")});
  const auto isOneDone = [&] {
    const auto names = runs();
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return name[0] != '.' && fs::exists(folder.path("out/runs/" + name + "/metrics.json"));
    });
  };
  EXPECT_TRUE(test::happens([&] { return stopped.hasEnded() || isOneDone(); }));
  stopped.signal(SIGINT);
  EXPECT_EQ(stopped.wait(), 1);
  EXPECT_THAT(stopped.err(), HasSubstr("slam-compare: error: interrupted: "));
  EXPECT_THAT(stopped.err(), HasSubstr("of 4 runs are finished; the same command continues"));
  EXPECT_FALSE(fs::exists(folder.path("out/report.html")));
  const auto left = runs();
  EXPECT_GE(left.size(), 1u);
  EXPECT_LT(left.size(), 4u);
  std::map<std::string, fs::file_time_type> finished;
  for (const std::string& name : left) {
    EXPECT_THAT(name, Not(StartsWith(".")));
    finished[name] = fs::last_write_time(folder.path("out/runs/" + name + "/metrics.json"));
  }

  EXPECT_EQ(run(kSmall + kTruth).status, 0);
  EXPECT_EQ(untimedTable(), whole);
  for (const auto& [name, time] : finished)
    EXPECT_EQ(fs::last_write_time(folder.path("out/runs/" + name + "/metrics.json")), time) << name;
}

TEST_F(SlamCompare, ADamagedRunIsRunAgain) {
  const std::string arguments = "--methods general --seeds 3 -q";
  ASSERT_EQ(run(arguments).status, 0);
  const std::string whole = untimedTable();
  const std::string damaged = "out/runs/general-3-2/trajectory.tum";
  fs::resize_file(folder.path(damaged), fs::file_size(folder.path(damaged)) / 2);
  const Outcome report = run(arguments + " --report-only");
  EXPECT_EQ(report.status, 1);
  EXPECT_THAT(report.err,
              HasSubstr("run cannot be evaluated: out/runs/general-3-2; damaged file: " + damaged));
  EXPECT_EQ(table("results.csv")[1].at("status"), "failed");
  EXPECT_EQ(table("results.csv")[2].at("status"), "done");
  const Outcome again = run(arguments);
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.err, "slam-compare: warning: damaged run: " + damaged + "; it is run again\n");
  EXPECT_EQ(untimedTable(), whole);
}

TEST_F(SlamCompare, MoreSeedsKeepExistingRuns) {
  ASSERT_EQ(run("--methods general --seeds 1 -q").status, 0);
  const auto before = fs::last_write_time(folder.path("out/runs/general-3-1/metrics.json"));
  ASSERT_EQ(run("--methods general --seeds 2 -q").status, 0);
  EXPECT_EQ(table("results.csv").size(), 2u);
  EXPECT_EQ(fs::last_write_time(folder.path("out/runs/general-3-1/metrics.json")), before);
}

TEST_F(SlamCompare, AFinishedRunOfAnotherComparisonIsAnError) {
  ASSERT_EQ(run("--methods general --seeds 1 -q").status, 0);
  const std::string error = errorLine(run("--methods general --seeds 1 -q --set grid.resolution=0.1"));
  EXPECT_THAT(error, HasSubstr("out/runs/general-3-1"));
  EXPECT_THAT(error, HasSubstr("[grid] resolution = 0.05, now 0.1"));

  fs::copy(kLog, folder.path("copy.rawlog"));
  const std::string withCopy =
      std::string("'") + SLAM_COMPARE + "' " + config + " copy.rawlog -o out2 --methods general --seeds 1 -q";
  ASSERT_EQ(shell(withCopy).status, 0);
  fs::last_write_time(folder.path("copy.rawlog"), fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_THAT(errorLine(shell(withCopy)), HasSubstr("out2/runs/general-3-1"));
}

TEST_F(SlamCompare, AFailingRunIsRecordedAndTheOthersContinue) {
  const Outcome o =
      run("--methods general --seeds 2 -q --variant "
          "broken:particle_filter.proposal=auxiliary_standard,particle_filter.resampling=residual" +
          kTruth);
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.err, HasSubstr("run failed: out/runs/general-broken-3-2: residual resampling is biased"));
  EXPECT_THAT(o.err, HasSubstr("slam-compare: error: 2 of 4 runs failed"));
  const auto rows = table("results.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("status"), "done");
  EXPECT_EQ(rows[3].at("status"), "failed");
  EXPECT_EQ(rows[3].at("ate_rmse_m"), "");
  const std::string report = this->report();
  EXPECT_THAT(report, HasSubstr("residual resampling is biased"));
  const auto json = nlohmann::json::parse(test::contentOf(folder.path("out/summary.json")));
  EXPECT_EQ(json["groups"][1]["success"]["successes"], 0);
}

TEST_F(SlamCompare, ReportOnlyStartsNothing) {
  ASSERT_EQ(run("--methods general --seeds 1 -q").status, 0);
  const Outcome o = run("--methods general --seeds 3 -q --report-only");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(runs(), ElementsAre("general-3-1"));
  const auto rows = table("results.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("status"), "done");
  EXPECT_EQ(rows[2].at("status"), "missing");
  report();
}

TEST_F(SlamCompare, ListedCommandsMakeTheSameRuns) {
  const Outcome list = run("--methods general --seeds 1 --list --set 'input.sensor_label='");
  ASSERT_EQ(list.status, 0) << list.err;
  ASSERT_THAT(list.out, StartsWith("general-3-1\t"));
  EXPECT_FALSE(fs::exists(folder.path("out")));
  const std::string command =
      list.out.substr(list.out.find('\t') + 1, list.out.find('\n') - list.out.find('\t') - 1);
  ASSERT_EQ(shell(command + " -o out/runs/general-3-1").status, 0);
  EXPECT_EQ(run("--methods general --seeds 1 -q --report-only").status, 0);
  EXPECT_EQ(table("results.csv").at(0).at("status"), "done");
}

TEST_F(SlamCompare, OptionsMayPrecedeTheFiles) {
  for (const std::string last : {"-m hybrid,general", "-n 4,5"}) {
    const Outcome list = shell(std::string("'") + SLAM_COMPARE + "' -o out --seeds 1 --list " + last + " " +
                               config + " " + kLog);
    EXPECT_EQ(list.status, 0) << list.err;
    EXPECT_THAT(list.out, HasSubstr("general-"));
  }
}

TEST_F(SlamCompare, TwoProcessesInOneFolderAreAnError) {
  fs::create_directories(folder.path("out"));
  EXPECT_THAT(errorLine(shell("flock out/.lock " + call("--methods general --seeds 1 -q"))),
              HasSubstr("another slam-compare is running"));
}

TEST_F(SlamCompare, EveryWrongInputIsOneLineAndStartsNoRun) {
  folder.write("far.tum", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  folder.write("broken.relations", "1287388800.0 1287388801.0 1 0 0 0 0 0\n1287388800.0 oops\n");
  folder.write("far.relations", "1 2 1 0 0 0 0 0\n");
  folder.write("broken.plan", "wall 0 0\n");
  folder.write("far.plan", "rectangle 1000 1000 1010 1010\n");
  folder.write("wrong.ini", "[particle_filter]\nparticels = 3\n");
  folder.write("text.rawlog", "not a rawlog\n");
  const std::string reference = " --reference " + kCsie + "csie-corridor.tum";
  const std::pair<std::string, std::string> cases[] = {
      {"--methods gmapping", "unknown method `gmapping`"},
      {"--methods hybrid --seeds 0", "--seeds"},
      {"--seeds many", "--seeds"},
      {"--first-seed -1", "--first-seed"},
      {"--jobs -1", "--jobs"},
      {"--particles 20,0", "--particles"},
      {"--particles x", "--particles"},
      {"--variant nothing", "--variant"},
      {"--variant x:run.method=stock", "run.method"},
      {"--variant x:grid.resolutoin=1", "resolution"},
      {"--variant x:@none.ini", "none.ini"},
      {"--set grid.resolution=-1", "grid"},
      {"--set particle_filter.seed=3", "particle_filter.seed"},
      {"--reference none.tum", "none.tum"},
      {"--reference far.tum", "reference"},
      {"--relations none.relations", "none.relations"},
      {"--relations broken.relations", "line 2"},
      {"--relations far.relations", "relation"},
      {"--odometry broken.relations", "--relations"},
      {"--floorplan " + kCsie + "csie.plan", "--reference"},
      {reference + " --floorplan none.plan", "none.plan"},
      {reference + " --floorplan broken.plan", "line 1"},
      {reference + " --floorplan far.plan", "no scan sees a wall of the floor plan"},
      {"--success-trans 0", "--success-trans"},
      {"--success-rot nan", "--success-rot"},
      {"--success-doubled -1", "--success-doubled"},
      {"--success-relations 0", "--success-relations"},
      {"--success-revisit nan", "--success-revisit"},
      {"--revisits 0", "--revisits"},
      {"--revisits far", "--revisits"},
      {"--unknown", "--unknown"},
  };
  for (const auto& [arguments, named] : cases)
    EXPECT_THAT(errorLine(run(arguments + " -q")), HasSubstr(named)) << arguments;
  const std::string program = std::string("'") + SLAM_COMPARE + "' ";
  const std::pair<std::string, std::string> calls[] = {
      {"-o out", "no log"},
      {config + " -o out", "no log"},
      {config + " " + kLog, "--output"},
      {"none.ini " + kLog + " -o out", "none.ini"},
      {"wrong.ini " + kLog + " -o out", "particels"},
      {config + " none.rawlog -o out", "none.rawlog"},
      {config + " text.rawlog -o out", "text.rawlog"},
      {config + " " + kLog + " -o small.ini/out", "small.ini/out"},
  };
  for (const auto& [arguments, named] : calls)
    EXPECT_THAT(errorLine(shell(program + arguments)), HasSubstr(named)) << arguments;
  EXPECT_FALSE(fs::exists(folder.path("out/runs")));
}

}  // namespace
}  // namespace hybrid_slam
