// simul-floorplan from the command line: files and one-line errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/zip.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CRawlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "Shell.h"
#include "files/TemporaryFolder.h"
#include "study/simulation/Simulation.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::Outcome;
using testing::HasSubstr;
using testing::StartsWith;

/// A temporary folder per test, with a small room, a short route and their INI file.
class SimulFloorplan : public testing::Test {
 protected:
  SimulFloorplan() {
    write("room.plan", "rectangle 0 0 8 6\ncircle 6 4 0.5\n");
    write("room.route", "start 1 1 0\nspeed 0.5\ngo 6 1\ngo 6 2.5\n");
    write("room.ini", "[simulation]\nplan = room.plan\nroute = room.route\n");
  }

  void write(const std::string& name, const std::string& text) const { folder.write(name, text); }

  Outcome call(const std::string& command) const { return test::shell(folder, command); }
  Outcome simulate(const std::string& arguments) const { return call("'" SIMUL_FLOORPLAN "' " + arguments); }

  /// Expects one clear line, exit code 2 and no file.
  void expectInputError(const std::string& arguments, const std::string& part) const {
    test::expectInputError(simulate(arguments), "simul-floorplan", part);
    EXPECT_FALSE(fs::exists(folder.path("out.rawlog")));
    EXPECT_FALSE(fs::exists(folder.path(".partial.out.rawlog")));
  }

  files::TemporaryFolder folder;
};

constexpr const char* kRun = "room.ini -o out.rawlog";

TEST_F(SimulFloorplan, WritesRawlogGroundTruthAndPicture) {
  const Outcome outcome = simulate(kRun);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("scans"));
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(folder.path("out.rawlog")));
  size_t scans = 0;
  for (const auto& entry : rawlog) scans += IS_CLASS(*entry, mrpt::obs::CObservation2DRangeScan);
  std::ifstream truth(folder.path("out.tum"));
  size_t rows = 0;
  for (std::string line; std::getline(truth, line); ++rows) {
    std::istringstream parts(line);
    const std::vector<double> numbers(std::istream_iterator<double>(parts), {});
    ASSERT_EQ(numbers.size(), 8u);
    EXPECT_NEAR(numbers[6] * numbers[6] + numbers[7] * numbers[7], 1, 1e-8);
    if (rows == 0) {
      EXPECT_EQ(std::vector<double>(numbers.begin(), numbers.begin() + 4),
                (std::vector<double>{1287388800, 1, 1, 0}));
    }
  }
  EXPECT_EQ(scans, 76u);  // 5 m and 1.5 m at 0.5 m/s, 2 s of turning, at 5 Hz, both ends counted
  EXPECT_EQ(rows, scans);
  EXPECT_THAT(test::contentOf(folder.path("out.png")), StartsWith("\x89PNG"));
  EXPECT_FALSE(fs::exists(folder.path(".partial.out.rawlog")));
}

TEST_F(SimulFloorplan, ReplacesAnEarlierSimulationOnly) {
  for (const char* name : {"out.rawlog", "out.tum", "out.png"}) {
    write(name, "of the user");
    test::expectInputError(simulate(kRun), "simul-floorplan",
                           "the output exists and is no earlier simulation: " + std::string(name));
    EXPECT_EQ(test::contentOf(folder.path(name)), "of the user");
    fs::remove(folder.path(name));
  }
  ASSERT_EQ(simulate(kRun).status, 0);
  EXPECT_EQ(simulate(kRun).status, 0);
  // A recording with its truth and a picture has the same names.
  for (const char* name : {"out.rawlog", "out.tum", "out.png"}) {
    const std::string before = test::contentOf(folder.path(name));
    write(name, "of the user");
    test::expectInputError(simulate(kRun), "simul-floorplan",
                           "the output exists and is no earlier simulation: out.rawlog");
    EXPECT_EQ(test::contentOf(folder.path(name)), "of the user");
    write(name, before);
  }
  for (const std::string form : {"pairs", "observations"}) {
    const std::string set = " --set simulation.form=" + form;
    EXPECT_EQ(simulate(kRun + set).status, 0);
    EXPECT_EQ(simulate(kRun + set).status, 0);
    test::expectInputError(simulate(kRun + set + " --set simulation.start_time=1300000000.4"),
                           "simul-floorplan", "the output exists and is no earlier simulation: out.rawlog");
  }
}

TEST_F(SimulFloorplan, TheSameSeedGivesTheSameBytesInEveryFile) {
  ASSERT_EQ(simulate("room.ini -o a.rawlog").status, 0);
  ASSERT_EQ(simulate("room.ini -q -s 1 -o b.rawlog").status, 0);
  ASSERT_EQ(simulate("room.ini -s 2 -o c.rawlog").status, 0);
  for (const char* extension : {".rawlog", ".tum", ".png"})
    EXPECT_TRUE(test::contentOf(folder.path("a" + std::string(extension))) ==
                test::contentOf(folder.path("b" + std::string(extension))))
        << extension;
  EXPECT_FALSE(test::contentOf(folder.path("a.rawlog")) == test::contentOf(folder.path("c.rawlog")));
  const std::string header = test::contentOf(folder.path("a.rawlog")).substr(4, 4);
  EXPECT_EQ(header, std::string(4, '\0'));  // gzip's MTIME; b may be of the same second
}

TEST_F(SimulFloorplan, WritesAllFilesOrNone) {
  write("out.part.rawlog", "of the user");
  ASSERT_EQ(call("mkdir out.tum").status, 0);
  expectInputError(kRun, "cannot write: out.tum");
  EXPECT_FALSE(fs::exists(folder.path("out.png")));
  ASSERT_EQ(call("rmdir out.tum").status, 0);
  ASSERT_EQ(simulate(kRun).status, 0);
  EXPECT_EQ(test::contentOf(folder.path("out.part.rawlog")), "of the user");
}

TEST_F(SimulFloorplan, QuietHelpAndVersion) {
  EXPECT_EQ(simulate("room.ini -q -o out.rawlog").out, "");
  EXPECT_EQ(simulate("--help").status, 0);
  EXPECT_THAT(simulate("--help").out, HasSubstr("--output"));
  EXPECT_EQ(simulate("--version").status, 0);
}

TEST_F(SimulFloorplan, SettingsOverrideTheFile) {
  ASSERT_EQ(simulate(std::string(kRun) + " --set simulation.form=pairs --set simulation.scans=7").status, 0);
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(folder.path("out.rawlog")));
  EXPECT_EQ(rawlog.size(), 14u);
  EXPECT_EQ(rawlog.getType(0), mrpt::obs::CRawlog::etActionCollection);
}

TEST_F(SimulFloorplan, WrongCommandLines) {
  expectInputError("", "config is required");
  expectInputError("room.ini", "--output is required");
  expectInputError("room.ini -o out.rawlog --fast", "--fast");
  expectInputError("none.ini -o out.rawlog", "no such file: none.ini");
  expectInputError(". -o out.rawlog", "not a file");
  expectInputError("room.ini -o out.txt", "expected a name ending in .rawlog");
  expectInputError("room.ini -o nowhere/out.rawlog", "no such folder");
  expectInputError("room.ini -o out.rawlog -s -3", "Value -3 not in range");
  EXPECT_LT(simulate("room.ini -o out.rawlog -s -3").err.size(), 150u);
  expectInputError("room.ini -o out.rawlog --set rate=3", "expected SECTION.KEY=VALUE");
}

TEST_F(SimulFloorplan, WrongIniFiles) {
  expectInputError(std::string(kRun) + " --set laser.sensor=LMS-300",
                   "wrong value `LMS-300`: command line, section [laser], key `sensor`; expected one of "
                   "LMS-100 | LMS-200");
  expectInputError(std::string(kRun) + " --set laser.resolution_deg=1",
                   "the LMS-100 does not have this resolution");
  expectInputError(std::string(kRun) + " --set laser.rat=4", "the nearest known key is `rate`");
  expectInputError(std::string(kRun) + " --set lasers.rate=4", "unknown section [lasers]");
  expectInputError(std::string(kRun) + " --set odometry.slips=12", "wrong slip `12`");
  expectInputError(std::string(kRun) + " --set simulation.robot_radius=-1", "expected a number in 0..5 m");
  write("room.ini", "[simulation]\nroute = room.route\n");
  expectInputError(kRun, "missing key: section [simulation], key `plan`");
  write("room.ini", "[simulation]\nplan = room.plan\nroute = none.route\n");
  expectInputError(kRun, "cannot be read: file none.route");
}

TEST_F(SimulFloorplan, WrongFloorPlans) {
  write("room.plan", "rectangle 0 0 8 6\npolygon 3 3 4 3 4 4\n");
  expectInputError(kRun, "`polygon` with 6 numbers: file room.plan, line 2");
  write("room.plan", "rectangle 0 0 8 6\npolygon 3 3 4 3 4 4 3 4\n");
  expectInputError(
      kRun, "polygon is not closed: file room.plan, line 2; expected the last point to repeat the first");
  write("room.plan", "rectangle 0 0 8 6\nwall 3 3 3 3\n");
  expectInputError(kRun, "wall of zero length: file room.plan, line 2");
  write("room.plan", "rectangle 0 0 8 6\nwindow 3 3 3 3\n");
  expectInputError(kRun, "unknown word `window`: file room.plan, line 2");
  write("room.plan", "");
  expectInputError(kRun, "floor plan without walls");
  fs::remove(folder.path("room.plan"));
  expectInputError(kRun, "cannot be read: file room.plan");
  ASSERT_EQ(::mkfifo(folder.path("room.plan").c_str(), 0600), 0);
  expectInputError(kRun, "room.plan");
}

/// The lines of a file, without or with a comment.
std::vector<std::string> linesOf(const std::string& file, bool commented) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if ((line.find('#') != std::string::npos) == commented) lines.push_back(line);
  return lines;
}

TEST_F(SimulFloorplan, SessionsDifferInDoorsBoxesAndNoiseButNotInWalls) {
  write("room.plan", "rectangle 0 0 8 6\ncircle 6 4 0.5\ndoor 2 6 3 6\n");
  write("room.things", "door 2 6 3 6\nbox 0.5 0.5  1 3  3 3  7 1  1 5\nbox 0.4 0.4  2 2  4 4  7 5\n");
  const std::string run = "room.ini -q --set simulation.things=room.things ";
  ASSERT_EQ(simulate(run + "-o a.rawlog").status, 0);
  ASSERT_EQ(simulate(run + "--session 1 -o b.rawlog").status, 0);
  ASSERT_EQ(simulate(run + "--session 2 -o c.rawlog").status, 0);
  ASSERT_EQ(simulate(run + "--set simulation.session=2 -o d.rawlog").status, 0);
  for (const char* extension : {".rawlog", ".tum", ".png", ".truth.plan"}) {
    const auto bytes = [&](const char* name) {
      return contentOf(folder.path(name + std::string(extension)));
    };
    EXPECT_TRUE(bytes("a") == bytes("b")) << extension;
    EXPECT_TRUE(bytes("c") == bytes("d")) << extension;
    EXPECT_EQ(bytes("a") == bytes("c"), std::string(extension) == ".tum") << extension;
  }
  const std::string first = folder.path("a.truth.plan"), second = folder.path("c.truth.plan");
  EXPECT_EQ(linesOf(first, false), linesOf(second, false));
  EXPECT_NE(linesOf(first, true), linesOf(second, true));
  EXPECT_THAT(linesOf(first, true), testing::Contains(testing::EndsWith("# box 1")));
  EXPECT_FALSE(fs::exists(folder.path(".partial.a.truth.plan")));

  // Without things, the log of the first session is unchanged.
  ASSERT_EQ(simulate("room.ini -q -o e.rawlog").status, 0);
  EXPECT_FALSE(fs::exists(folder.path("e.truth.plan")));
}

TEST_F(SimulFloorplan, WrongThingsAndSessions) {
  const std::string run = std::string(kRun) + " --set simulation.things=room.things";
  expectInputError(run, "cannot be read: file room.things");
  expectInputError("room.ini -o out.rawlog --session 0", "--session");
  expectInputError(std::string(kRun) + " --set simulation.session=0", "expected a whole number in 1..");
  write("room.things", "box 0.5 0.5  1 3  7.8 3\n");
  expectInputError(run, "box at (7.80, 3.00) stands on a wall or a door: file room.things, line 1");
  // One of five places is on the route: an error also in the sessions in which the box is elsewhere.
  write("room.things", "box 0.5 0.5  1 3  3 3  5 3  3 4  3 0.8\n");
  for (const char* session : {"1", "2", "3", "4"})
    expectInputError(run + " --session " + session, "path hits a wall at (2.7");
  write("room.things", "door 4 0.2 4 2\n");
  expectInputError(run, "path hits a wall at (3.7");
}

/// Each of these inputs would take all memory, or hours.
TEST_F(SimulFloorplan, WhatIsTooLargeIsAnError) {
  write("room.route", "start 1 1 0\nwait 1e300\n");
  expectInputError(kRun, "`1e300` is too large: file room.route, line 2");
  std::string waits = "start 1 1 0\ngo 6 1\n";
  for (int i = 0; i < 1000; ++i) waits += "wait 100000\n";
  write("room.route", waits);
  expectInputError(kRun, "too many readings: 27777.8 h");
  write("room.route", "start 1 1 0\nspeed 1e-9\ngo 6 1\n");
  expectInputError(kRun, "`speed` too low: file room.route, line 2");
  write("room.route", "start 1 1 0\nspeed 1\ngo 6 1\nwait 30000\n");
  expectInputError(std::string(kRun) + " --set odometry.rate=100 --set laser.rate=0.1",
                   "too many readings: 8.3 h");
  write("room.route", std::string(2 << 20, 'x'));
  expectInputError(kRun, "not a text log: room.route, line 1");
  write("room.route", std::string(1 << 19, 'x') + " 1 1 0\n");
  expectInputError(kRun, "unknown word `xxx");
  std::string many;
  for (int i = 0; i < 20001; ++i) many += "wall 0 0 8 0\n";
  write("room.plan", many);
  expectInputError(kRun, "too many lines: file room.plan, line 20001");
  write("room.plan", "wall 0 0 1e9 0\n");
  expectInputError(kRun, "`1e9` is too large: file room.plan, line 1");
}

TEST_F(SimulFloorplan, APlanOfManyKilometresHasASmallPicture) {
  write("room.plan", "rectangle 0 0 100000 60000\n");
  EXPECT_EQ(simulate(kRun).status, 0);
  EXPECT_LT(fs::file_size(folder.path("out.png")), 10000000u);
  write("room.route", "start 1 1 0\nspeed 100\ngo 90000 1\ngo 1 1\n");
  for (const char* name : {"out.rawlog", "out.tum", "out.png"}) fs::remove(folder.path(name));
  expectInputError(kRun, "route too long: 180.0 km");
}

TEST_F(SimulFloorplan, WrongRoutes) {
  write("room.route", "start 1 1 0\ngo 7.9 1\n");
  expectInputError(kRun, "way point inside a wall at (7.90, 1.00): file room.route, line 2");
  write("room.route", "start 1 4 0\ngo 7.5 4\n");
  expectInputError(kRun, "path hits a wall at (5.2");
  expectInputError(std::string(kRun) + " --set simulation.robot_radius=0", "path crosses a wall at (5.5");
  write("room.route", "start 1 4 0\nrun 7.5 4\n");
  expectInputError(kRun, "unknown word `run`: file room.route, line 2");
}

TEST_F(SimulFloorplan, AFullDiskIsAFailureThatLeavesNoFile) {
  const Outcome outcome = call(std::string("sh -c \"ulimit -f 1; trap '' XFSZ; '") + SIMUL_FLOORPLAN +
                               "' room.ini -o out.rawlog\"");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("simul-floorplan: error: cannot write: out.rawlog; "));
  for (const auto& entry : fs::directory_iterator(folder.path("")))
    EXPECT_NE(entry.path().stem().string().substr(0, 3), "out") << entry.path();
}

/// Describes files with different bytes: file, sizes, and whether only the compression differs.
std::string differenceOf(const fs::path& made, const fs::path& committed) {
  const std::string a = test::contentOf(made), b = test::contentOf(committed);
  if (a == b) return "none";
  std::string text = made.filename().string() + ": " + std::to_string(a.size()) + " bytes made, " +
                     std::to_string(b.size()) + " committed";
  std::vector<uint8_t> plainA, plainB;
  mrpt::io::zip::decompress_gz_data_block({a.begin(), a.end()}, plainA);
  mrpt::io::zip::decompress_gz_data_block({b.begin(), b.end()}, plainB);
  if (plainA == plainB) return text + "; the same once decompressed: another zlib";
  const auto [first, _] = std::mismatch(plainA.begin(), plainA.end(), plainB.begin(), plainB.end());
  return text + "; decompressed, the first difference is at byte " + std::to_string(first - plainA.begin()) +
         " of " + std::to_string(plainA.size());
}

TEST_F(SimulFloorplan, TheCommittedCsieLogsAreRemadeByteForByte) {
  const fs::path source = SOURCE_DIR, committed = source / "datasets/csie";
  const Outcome outcome = call("'" + (source / "scripts/make-csie.sh").string() + "' '" + folder.path("") +
                               "' '" + SIMUL_FLOORPLAN + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* route : {"csie-loop", "csie-doorways", "csie-corridor"})
    for (const char* extension : {".rawlog", ".tum", ".png"}) {
      const std::string name = std::string(route) + extension;
      EXPECT_EQ(differenceOf(folder.path(name), committed / name), "none");
    }
  for (const auto& entry : fs::directory_iterator(committed))
    EXPECT_LT(fs::file_size(entry.path()), 1000000u) << entry.path();
}

TEST_F(SimulFloorplan, TheCsieBuildingIsSimulatedForAnyTime) {
  const std::string ini = "'" + std::string(SOURCE_DIR) + "/config-ini/simul-csie.ini'";
  ASSERT_EQ(simulate(ini + " -q -o out.rawlog --set simulation.scans=50").status, 0);
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(folder.path("out.rawlog")));
  size_t scans = 0;
  for (const auto& entry : rawlog) scans += IS_CLASS(*entry, mrpt::obs::CObservation2DRangeScan);
  EXPECT_EQ(scans, 50u);
}

TEST_F(SimulFloorplan, TheChangingBuildingIsSimulatedInAnySession) {
  const std::string ini = "'" + std::string(SOURCE_DIR) + "/config-ini/simul-moved.ini'";
  for (const char* session : {"1", "2", "1000000"})
    EXPECT_EQ(simulate(ini + " -q -o out.rawlog --set simulation.scans=50 --session " + session).status, 0);
  const std::vector<std::string> things = linesOf(folder.path("out.truth.plan"), true);
  const auto ofBoxes = std::count_if(things.begin(), things.end(), [](const std::string& line) {
    return line.find("# box") != std::string::npos;
  });
  EXPECT_EQ(ofBoxes, 6 * 4);
}

TEST_F(SimulFloorplan, TheCorridorLogHas378Steps) {
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(std::string(SOURCE_DIR) + "/datasets/csie/csie-corridor.rawlog"));
  EXPECT_EQ(rawlog.size(), 2 * 378u);
}

/// Returns the rows of doc/simulation.md for the options.
std::string rowsOf(const Options& options) {
  std::string rows;
  for (const auto& option : options.table()) {
    std::string range = option.range;
    for (size_t at = 0; (at = range.find('|', at)) != std::string::npos; at += 2) range.insert(at, "\\");
    rows += "| `" + option.key + "` | " + option.get() + " | " + option.unit + " | " + range + " | " +
            option.why + " |\n";
  }
  return rows;
}

TEST(SimulationDocument, ListsEveryKeyWithItsDefaultUnitAndBounds) {
  const std::string document = test::contentOf(std::string(SOURCE_DIR) + "/doc/simulation.md");
  EXPECT_THAT(document, HasSubstr(rowsOf(simulation::SimulationOptions())));
  EXPECT_THAT(document, HasSubstr(rowsOf(simulation::LaserOptions())));
  EXPECT_THAT(document, HasSubstr(rowsOf(simulation::OdometryOptions())));
}

}  // namespace
}  // namespace hybrid_slam
