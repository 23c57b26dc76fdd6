/// slam-compare from the command line: complete comparisons, failing runs, all kinds of invalid input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "InstalledProgram.h"
#include "SlamCompareProgram.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using testing::HasSubstr;
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

TEST_F(SlamCompare, SaysWhichLasersEachGroupTakes) {
  test::Log log = test::laps(40);
  for (size_t i = 40; i > 0; --i)
    log.insert(log.begin() + 2 * static_cast<std::ptrdiff_t>(i),
               test::scan(1000 + 0.2 * static_cast<double>(i - 1), test::poseOnLap(i - 1, 80), 91, "REAR"));
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  const std::string call = "'" SLAM_COMPARE "' " + config + " '" + path + "' -o out -m general --seeds 1 ";
  const std::string variant = "--variant one:input.sensor_label=LASER ";
  const Outcome o = shell(call + variant);
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, testing::MatchesRegex("laser LASER: 181 beams [^\n]*\n"
                                           "laser REAR: 91 beams [^\n]*\n[^\n]*report.html\n"));
  const std::string ignored =
      "slam-compare: warning: general-one: laser `REAR` is not used: not in [input] sensor_label\n";
  EXPECT_THAT(o.err, HasSubstr(ignored));
  const Outcome quiet = shell(call + "-q " + variant);
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(quiet.err, ignored);
  EXPECT_THAT(shell(call + "--list").out, testing::StartsWith("general-3-1\t"));
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

TEST_F(SlamCompare, EachVariantOfTheInputHasItsOwnSettingsOfTheLog) {
  test::Log log;
  for (int i = 0; i < 40; ++i) {  // at 0.625 m/s, with odometry every 0.5 m
    const double time = 1000 + 0.2 * i;
    const test::TPose2D pose(-2.5 + 0.125 * i, 0, 0);
    if (i % 4 == 0) log.push_back(test::odometry(time, pose));
    log.push_back(test::scan(time, pose));
  }
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  for (const char* call : {"first", "second"}) {
    const Outcome o = shell("'" SLAM_COMPARE "' " + config + " '" + path +
                            "' -o out --methods general --seeds 1 -q --variant "
                            "gap:input.max_odometry_gap=0.5");
    EXPECT_EQ(o.status, 0) << call << ": " << o.err;
  }
  for (const auto& [name, distance] : {std::pair{"general-3-1", "0.1"}, {"general-gap-3-1", "0.02"}})
    EXPECT_THAT(test::contentOf(folder.path(std::string("out/runs/") + name + "/config.ini")),
                HasSubstr(std::string("update_distance = ") + distance));
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

TEST_F(SlamCompare, OptionsMayPrecedeTheFiles) {
  for (const std::string last : {"-m hybrid,general", "-n 4,5"}) {
    const Outcome list = shell(std::string("'") + SLAM_COMPARE + "' -o out --seeds 1 --list " + last + " " +
                               config + " " + kLog);
    EXPECT_EQ(list.status, 0) << list.err;
    EXPECT_THAT(list.out, HasSubstr("general-"));
  }
}

TEST_F(SlamCompare, AReportThatIsNotOursStays) {
  fs::create_directory(folder.path("out"));
  folder.write("out/report.html", "mine");
  EXPECT_THAT(errorLine(run(kSmall)),
              HasSubstr("the output exists and is of no comparison: out/report.html"));
  EXPECT_EQ(test::contentOf(folder.path("out/report.html")), "mine");
}

TEST_F(SlamCompare, TablesDoNotReplaceAnInput) {
  fs::create_directories(folder.path("out/runs"));
  const std::string truth = test::contentOf(SOURCE_DIR "/datasets/csie/csie-corridor.tum");
  folder.write("out/summary.json", truth);
  EXPECT_THAT(errorLine(run(kSmall + " --reference out/summary.json")),
              HasSubstr("the results would replace an input: out/summary.json"));
  fs::create_hard_link(config, folder.path("out/summary.csv"));
  EXPECT_THAT(errorLine(run(kSmall)), HasSubstr("the results would replace an input: " + config));
  fs::remove(folder.path("out/summary.csv"));
  fs::copy_file(config, folder.path("out/results.csv"));
  EXPECT_THAT(errorLine(run(kSmall + " --variant hybrid/other:@out/results.csv")),
              HasSubstr("the results would replace an input: out/results.csv"));
  EXPECT_EQ(test::contentOf(folder.path("out/summary.json")), truth);
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
