/// slam-merge from the command line: two sessions or maps, no overlap, all kinds of invalid input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "InstalledProgram.h"
#include "Shell.h"
#include "files/TemporaryFolder.h"
#include "files/Trajectory.h"
#include "run/KnownMap.h"
#include "run/MapPartFile.h"
#include "run/SessionFile.h"
#include "testing/TestLogs.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using testing::HasSubstr;

/// A drive along some sides of a square in a room without similar parts.
test::Log tour(int sides) {
  test::Log log;
  double time = 1000;
  for (const test::DriveStep& step : test::drive(sides)) {
    const auto scan = mrpt::obs::CObservation2DRangeScan::Create(step.scan);
    scan->timestamp = test::stamp(time);
    scan->sensorLabel = "LASER";
    log.push_back(test::odometry(time, step.truth));
    log.push_back(scan);
    time += 0.2;
  }
  return log;
}

class SlamMerge : public testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    return test::shell(folder, "'" SLAM_MERGE "' " + arguments);
  }
  /// Maps a tour into a folder; `more` are options.
  void map(const std::string& name, int sides, const std::string& more = "--set grid.resolution=0.1") const {
    const std::string log = test::writeGzipped(folder.path(name + ".rawlog"), tour(sides));
    const Outcome outcome = test::shell(folder, "'" HYBRID_SLAM "' " + log + " -q -o " + name + " " + more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  void expectInputError(const std::string& arguments, const std::string& part) const {
    test::expectInputError(run(arguments), "slam-merge", part);
    EXPECT_FALSE(fs::exists(folder.path("c")));
  }
  std::string content(const std::string& name) const { return test::contentOf(folder.path(name)); }

  files::TemporaryFolder folder;
};

TEST_F(SlamMerge, HelpAndVersion) {
  EXPECT_THAT(run("--help").out, HasSubstr("-o,--output"));
  EXPECT_EQ(run("--version").out, "slam-merge " HYBRID_SLAM_VERSION "\n");
}

TEST_F(SlamMerge, SessionsFoldersAndMapsOfOneRoom) {
  map("a", 4);
  map("b", 5, "-s 2 --set grid.resolution=0.1");
  const std::pair<const char*, const char*> pairs[] = {{"a", "b"},
                                                       {"a", "a"},
                                                       {"a/session.hslam", "b/map.yaml"},
                                                       {"a/map.gridmap.gz", "b/session.hslam"},
                                                       {"a/map.yaml", "b/map.gridmap.gz"}};
  for (const auto& [first, second] : pairs) {
    SCOPED_TRACE(std::string(first) + " " + second);
    const Outcome outcome = run(std::string(first) + " " + second + " --overwrite -o c");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("c/map.png"));
    const auto metrics = nlohmann::json::parse(content("c/metrics.json"));
    EXPECT_NEAR(metrics.at("x_m"), 0, 0.05);
    EXPECT_NEAR(metrics.at("y_m"), 0, 0.05);
    EXPECT_NEAR(metrics.at("phi_deg"), 0, 0.5);
    EXPECT_GT(metrics.at("fit"), 0.9);
    for (const char* name : {"map.pgm", "map.yaml", "map.png", "map.gridmap.gz", "lines.csv", "config.ini"})
      EXPECT_TRUE(fs::exists(folder.path(std::string("c/") + name))) << name;
    const run::SessionReader session(folder.path("c/session.hslam"));
    EXPECT_FALSE(session.hasRun());
    EXPECT_EQ(session.header().path.size(), metrics.at("updates"));
    EXPECT_NEAR(session.header().map.grid.resolution(), 0.1, 1e-9);
  }
}

TEST_F(SlamMerge, TheMergedMapIsMappedOnAndLocalisedInButNotResumed) {
  map("a", 4);
  ASSERT_EQ(run("a a -q -o c").status, 0);
  EXPECT_EQ(files::loadTum(folder.path("c/trajectory.tum")).size(),
            2 * run::SessionReader(folder.path("a/session.hslam")).header().path.size());
  for (const char* use : {"--continue", "--localize"}) {
    const Outcome outcome = test::shell(
        folder, std::string("'" HYBRID_SLAM "' a.rawlog -q --start 0,0,0 -o d ") + use + " c/session.hslam");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  test::expectInputError(test::shell(folder, "'" HYBRID_SLAM "' --resume c/session.hslam -o e"),
                         "hybrid-slam", "merged map");
  EXPECT_THAT(run("c a -q -o f").err, "") << "it is merged with others";
}

/// Beams without a return may have the limit of their log as range, which is shorter than that of the other
/// map.
TEST_F(SlamMerge, TheScansOfEachMapKeepItsRange) {
  map("a", 4, "--set grid.resolution=0.1 --set grid.max_range=5");
  const run::MapPartFile file = run::readMapPart(folder.path("a"));
  ASSERT_GT(file.part.scans.size(), 10u);
  for (const Scans& scans : file.part.scans)
    for (const auto& scan : scans) EXPECT_EQ(scan->maxRange, 5);
}

TEST_F(SlamMerge, ResultsThatAreThereStay) {
  map("a", 4);
  ASSERT_EQ(run("a a -q -o c").status, 0);
  const std::string before = content("c/metrics.json");
  const Outcome again = run("a a -o c");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(content("c/metrics.json"), before);
  EXPECT_THAT(again.out, HasSubstr("c/2"));
}

TEST_F(SlamMerge, ResultsDoNotReplaceAnInput) {
  map("a", 4);
  const std::string before = content("a/session.hslam");
  for (const char* maps : {"a a", "a/map.yaml a", "a/session.hslam a/map.yaml"})
    test::expectInputError(run(std::string(maps) + " --overwrite -o a"), "slam-merge",
                           "the results would replace an input: a/");
  std::string yaml = content("a/map.yaml");
  yaml.replace(yaml.find("map.pgm"), 7, "a/map.pgm");
  folder.write("elsewhere.yaml", yaml);
  test::expectInputError(run("a/session.hslam elsewhere.yaml --overwrite -o a"), "slam-merge",
                         "the results would replace an input: a/");
  test::expectInputError(run("elsewhere.yaml elsewhere.yaml --overwrite -o a"), "slam-merge",
                         "the results would replace an input: a/map.pgm");
  EXPECT_EQ(content("a/session.hslam"), before);
}

TEST_F(SlamMerge, NamesMayBeNoUtf8) {
  map("a", 4);
  fs::rename(folder.path("a"), folder.path("caf\xe9"));
  const Outcome outcome = run("'caf\xe9' 'caf\xe9' -q -o c");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(content("c/metrics.json"), HasSubstr("caf\uFFFD"));
}

TEST_F(SlamMerge, OtherCellSizes) {
  map("a", 4);
  map("b", 4, "--set grid.resolution=0.05");
  ASSERT_EQ(run("a b -q -o c").status, 0);
  EXPECT_NEAR(run::readKnownMap(folder.path("c/session.hslam")).grid.resolution(), 0.1, 1e-9);
  ASSERT_EQ(run("b/map.yaml a/map.yaml -q -o d").status, 0);
  EXPECT_NEAR(run::readKnownMap(folder.path("d/session.hslam")).grid.resolution(), 0.05, 1e-9);
}

TEST_F(SlamMerge, NoOverlapIsAnAnswerAndNoMap) {
  map("a", 4);
  // A corridor with pillars.
  std::string picture = "P5\n200 60\n255\n";
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 200; ++x)
      picture += static_cast<char>(y < 3 || y > 56 || (x * 7 + y * y) % 97 == 0 ? 0 : 254);
  folder.write("other.pgm", picture);
  folder.write("other.yaml",
               "image: other.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
               "free_thresh: 0.196\n");
  const Outcome outcome = run("a other.yaml -o c");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::MatchesRegex("slam-merge: error: no overlap found: [^\n]*\n"));
  EXPECT_FALSE(fs::exists(folder.path("c")));
}

TEST_F(SlamMerge, MapsMayBeInstalledOnes) {
  const test::InstalledProgram installed(folder, SLAM_MERGE);
  ASSERT_NO_FATAL_FAILURE(map("a", 1));
  fs::copy_file(folder.path("a/session.hslam"), installed.data("a"));
  std::ofstream(installed.data("text")) << "text";
  for (const std::string maps : {"data/text data/a", "data/a data/text"})
    test::expectInputError(test::shell(folder, "'" + installed.path + "' -o c " + maps), "slam-merge",
                           installed.data("text"));
}

TEST_F(SlamMerge, WrongInput) {
  map("a", 4);
  expectInputError("", "A");
  expectInputError("a", "B");
  expectInputError("a a", "--output");
  expectInputError("a missing -o c", "missing");
  expectInputError("missing.yaml a -o c", "missing.yaml");
  folder.write("text", "not a map\n");
  expectInputError("a text -o c", "text");
  fs::create_directory(folder.path("empty"));
  expectInputError("a empty -o c", "a folder, not a file: empty");
  const std::string session = content("a/session.hslam");
  folder.write("cut.hslam", session.substr(0, session.size() / 2));
  expectInputError("a cut.hslam -o c", "cut.hslam");
  std::string fine = content("a/map.yaml");
  fine.replace(fine.find("resolution: 0.1"), 15, "resolution: 0.005");
  folder.write("a/fine.yaml", fine);
  expectInputError("a/fine.yaml a/fine.yaml -o c", "expected a number in 0.01..1 m");
  folder.write("file", "in its place");
  test::expectInputError(run("a a -o file"), "slam-merge", "file");
}

}  // namespace
}  // namespace hybrid_slam
