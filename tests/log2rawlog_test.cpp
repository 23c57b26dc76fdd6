/// Exit code, messages and files of the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "InstalledProgram.h"
#include "Shell.h"
#include "readings/RawlogSource.h"
#include "testing/CompressedBytes.h"
#include "testing/TestLogs.h"
#include "testing/TinyslamRows.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Pair;

std::string scanRow(const std::string& time, const std::string& range = "2.5",
                    const std::string& name = "FLASER", int beams = 181) {
  std::string row = name + " " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) row += " " + range;
  return row + " 0 0 0 " + time + " 0 0 " + time + " host 0\n";
}

std::string odometryRow(const std::string& time, const std::string& x) {
  return "ODOM " + x + " 0 0 0 0 0 " + time + " host " + time + "\n";
}

class Log2Rawlog : public test::ProgramTest {
 protected:
  Log2Rawlog() : ProgramTest(LOG2RAWLOG) {}
  int convert(const std::string& input, const std::string& options = "", const std::string& before = "") {
    return run(options + " '" + input + "' '" + rawlog + "'", before);
  }
  /// Expects exit code 2, one error line and no file.
  void expectError(int exitCode, const std::string& text) {
    test::expectInputError({exitCode, out, err}, "log2rawlog", text);
    EXPECT_FALSE(fs::exists(rawlog));
    EXPECT_FALSE(fs::exists(folder.path(".partial.out.rawlog")));
  }
  size_t entries() const {
    mrpt::obs::CRawlog log;
    return log.loadFromRawLogFile(rawlog) ? log.size() : 0;
  }

  std::string rawlog = folder.path("out.rawlog");
};

using Log2RawlogAsUser = Log2Rawlog;  // skipped as root, apart from the others

TEST_F(Log2Rawlog, JumpsOfOdometryAndTimeAreReported) {
  const std::string log =
      folder.write("in.clf", odometryRow("10", "10") + scanRow("10") + odometryRow("11", "1e30") +
                                 odometryRow("12", "11") + odometryRow("13", "200") +
                                 odometryRow("100000013", "201") + odometryRow("14", "202"));
  EXPECT_EQ(convert(log), 0);
  EXPECT_EQ(err, "log2rawlog: warning: 1 impossible odometry reading: beyond 1e8 m or 1e6 rad: first in " +
                     log +
                     ", line 3; kept as logged\n"
                     "log2rawlog: warning: 1 odometry jump of over 100 m or far above the robot's speed: "
                     "first in " +
                     log +
                     ", line 5; kept as logged\n"
                     "log2rawlog: warning: 2 time jumps of over a day: first in " +
                     log + ", line 6; kept as logged\n");
  EXPECT_THAT(out, HasSubstr("path 3.0 m")) << "without the jumps";
}

/// The rawlog must not get the descriptor of standard error, and with it the warnings.
TEST_F(Log2Rawlog, ClosedStandardDescriptorsHarmNoResult) {
  const std::string log = folder.write("in.clf", odometryRow("10", "1e30") + scanRow("10") + "SYNC tag\n");
  EXPECT_EQ(convert(log), 0);
  const std::string expected = contentOf(rawlog);
  test::shell(folder, "('" LOG2RAWLOG "' '" + log + "' '" + rawlog + "' <&- >&- 2>&-; echo $? >code); true");
  EXPECT_EQ(contentOf(folder.path("code")), "0\n");
  EXPECT_EQ(contentOf(rawlog), expected);
}

TEST_F(Log2Rawlog, ChoosesAmongTheTopicsOfBagsOnly) {
  const std::string log = folder.write("in.clf", scanRow("10") + scanRow("12.5"));
  for (const std::string option : {"--topic", "--odometry-topic"}) {
    EXPECT_EQ(convert(log, option + " /odom"), 2);
    EXPECT_EQ(err, "log2rawlog: error: " + option + " for a log without topics: " + log +
                       "; expected a bag; hybrid-slam chooses among the sensors of other logs\n");
  }
}

TEST_F(Log2Rawlog, ConvertsAndPrintsASummary) {
  const std::string log = folder.write("in.clf", scanRow("10") + scanRow("12.5") + "SYNC tag\n");
  EXPECT_EQ(convert(log), 0);
  EXPECT_EQ(out, rawlog +
                     ": CARMEN log, 2 scans, 2 odometry readings, 2.5 s, path 2.5 m, 0 broken lines; "
                     "skipped: 1 SYNC\n");
  EXPECT_THAT(err, IsEmpty());
  EXPECT_EQ(entries(), 4u);
}

TEST_F(Log2Rawlog, ConvertsALogOfTinyslam) {
  EXPECT_EQ(convert(folder.write("exp.dat", test::tinyslamDrive(30))), 0);
  EXPECT_EQ(out,
            rawlog + ": tinySLAM log, 30 scans, 30 odometry readings, 5.8 s, path 2.4 m, 0 broken lines\n");
  EXPECT_THAT(err, IsEmpty());
  mrpt::obs::CRawlog log;
  ASSERT_TRUE(log.loadFromRawLogFile(rawlog));
  ASSERT_EQ(log.size(), 60u);
  const auto odometry = log.asObservation<mrpt::obs::CObservationOdometry>(58);
  EXPECT_NEAR(odometry->odometry.x(), 2.4, 1e-3);
  EXPECT_NEAR(odometry->odometry.y(), 0, 1e-9);
  const auto scan = log.asObservation<mrpt::obs::CObservation2DRangeScan>(59);
  EXPECT_EQ(scan->sensorLabel, "LASER");
  EXPECT_EQ(scan->maxRange, 5.6f);
  EXPECT_NEAR(scan->sensorPose.x(), 0.145, 1e-9);
  ASSERT_EQ(scan->getScanSize(), test::kTinyslamBeams);
  EXPECT_NEAR(scan->getScanRange(341), 5 - 1.2 - 2.4 - 0.145, 1e-3) << "straight ahead";
}

TEST_F(Log2Rawlog, ConvertsRawlogsToTheFormThatIsAskedFor) {
  ASSERT_EQ(convert(folder.write("in.clf", scanRow("10") + scanRow("12.5"))), 0);
  const std::string single = folder.path("single.rawlog"), pairs = folder.path("pairs.rawlog");
  const std::string summary = ": rawlog, 2 scans, 2 odometry readings, 2.5 s, path 2.5 m\n";
  const auto has = [this](bool arePairs) {
    mrpt::obs::CRawlog log;
    ASSERT_TRUE(log.loadFromRawLogFile(rawlog));
    ASSERT_EQ(log.size(), 4u);
    EXPECT_EQ(log.getType(0) == mrpt::obs::CRawlog::etActionCollection, arePairs);
    EXPECT_EQ(log.getType(3) == mrpt::obs::CRawlog::etSensoryFrame, arePairs);
  };
  fs::rename(rawlog, single);
  EXPECT_EQ(convert(single, "--action-observation"), 0);
  EXPECT_EQ(out, rawlog + summary);
  EXPECT_THAT(err, IsEmpty());
  has(true);
  fs::rename(rawlog, pairs);
  for (const std::string& log : {single, pairs}) {
    EXPECT_EQ(convert(log), 0);
    EXPECT_EQ(out, rawlog + summary);
    has(false);
    EXPECT_EQ(convert(log, "--action-observation --scan-time 0.02"), 0);
    has(true);
    EXPECT_THAT(readings::summarise(rawlog, {}).sweeps, ElementsAre(Pair("FLASER", 0.02)));
    fs::remove(rawlog);
    expectError(run("'" + log + "' '" + log + "'"), "the output is the input");
  }
}

TEST_F(Log2Rawlog, CompressedLogsGiveTheSameBytes) {
  const std::string log = scanRow("10") + scanRow("12.5");
  EXPECT_EQ(convert(folder.write("in.clf", log)), 0);
  const std::string plain = contentOf(rawlog);
  for (const files::Compression compression : test::kCompressions) {
    fs::remove(rawlog);
    EXPECT_EQ(convert(folder.write("packed", test::compressed(compression, log))), 0) << err;
    EXPECT_EQ(contentOf(rawlog), plain) << files::nameOf(compression);
  }
}

TEST_F(Log2Rawlog, BrokenLinesAreReportedAndSkipped) {
  const std::string log = folder.write("in.clf", scanRow("10") + "ODOM 1 2\n" + scanRow("11"));
  EXPECT_EQ(convert(log), 0);
  EXPECT_EQ(err, "log2rawlog: warning: broken line: " + log +
                     ", line 2; 2 fields where 9 were expected: x y theta tv rv acceleration ipc_time host "
                     "logger_time\n");
  EXPECT_THAT(out, HasSubstr("2 scans"));
  EXPECT_THAT(out, HasSubstr("1 broken lines"));
}

TEST_F(Log2Rawlog, NamesOfFilesAndLinesCannotActOnTheTerminal) {
  EXPECT_EQ(run("\"$(printf 'no\\033[2Jlog')\" out.rawlog"), 2);
  EXPECT_THAT(err, HasSubstr(R"(no\x1b[2Jlog)"));
  EXPECT_EQ(err.find('\x1b'), std::string::npos);
  const std::string log = folder.write("names.log", scanRow("1") + scanRow("2") + "NAME\x1b[2J a\n");
  EXPECT_EQ(convert(log), 0) << err;
  EXPECT_THAT(err, HasSubstr("[2J` is not a record's name"));
  EXPECT_EQ(err.find('\x1b'), std::string::npos);
}

TEST_F(Log2Rawlog, OnlyTheFirstBrokenLinesArePrinted) {
  std::string rows = scanRow("10");
  for (int i = 0; i < 5000; ++i) rows += "ODOM 1 2\n";
  const std::string log = folder.write("in.clf", rows);
  EXPECT_EQ(convert(log), 0);
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 11);
  EXPECT_THAT(err, testing::EndsWith("log2rawlog: warning: more broken lines: " + log +
                                     "; only counted from here on\n"));
  EXPECT_THAT(out, HasSubstr("5000 broken lines"));
  EXPECT_EQ(convert(log, "--format dpslam"), 2);
  EXPECT_LE(std::count(err.begin(), err.end(), '\n'), 12);
}

TEST_F(Log2Rawlog, StrictStopsAtABrokenLine) {
  const std::string log = folder.write("in.clf", scanRow("10") + "ODOM 1 2\n" + scanRow("11"));
  expectError(convert(log, "--strict"), "line 2; 2 fields");
}

TEST_F(Log2Rawlog, OptionsReachTheConversion) {
  const std::string log =
      folder.write("in.log", "Odometry 0 0 0\nLaser 3 1 2 3\nOdometry 1 0 0\nLaser 3 1 2 3\n");
  EXPECT_EQ(convert(log, "--format dpslam --period 0.25 --laser-x -0.4 --angular-step 2 --max-range 7"), 0);
  EXPECT_THAT(out, HasSubstr("DP-SLAM log, 2 scans, 2 odometry readings, 0.2 s"));
  EXPECT_EQ(convert(log, "--action-observation --angular-step 2"), 0);
  EXPECT_EQ(entries(), 4u);
  const std::string carmen = folder.write("in.clf", scanRow("10") + scanRow("20"));
  EXPECT_EQ(convert(carmen, "--time logger"), 0);
  EXPECT_THAT(out, HasSubstr(" 0.0 s,"));
  EXPECT_EQ(convert(carmen, "--time ipc"), 0);
  EXPECT_THAT(out, HasSubstr(" 10.0 s,"));
}

TEST_F(Log2Rawlog, TheScanTimeThatIsSetIsStatedForEachLaser) {
  const std::string log = folder.write("in.clf", scanRow("10") + scanRow("10", "2.5", "RLASER", 101));
  const auto stated = [&](const std::string& options) {
    EXPECT_EQ(convert(log, options), 0) << err;
    return readings::summarise(rawlog, {}).sweeps;
  };
  EXPECT_THAT(stated(""), IsEmpty());
  EXPECT_THAT(stated("--scan-time 0.02"), ElementsAre(Pair("FLASER", 0.02), Pair("RLASER", 0.02)));
  EXPECT_THAT(stated("--scan-rate 25"), ElementsAre(Pair("FLASER", DoubleNear(180. / 360 / 25, 1e-8)),
                                                    Pair("RLASER", DoubleNear(100. / 360 / 25, 1e-8))));
  EXPECT_THAT(stated("--scan-time 0"), IsEmpty());
}

TEST_F(Log2Rawlog, AMaximumRangeThatDoesNotFitTheLogGivesAWarning) {
  const std::string log = folder.write("in.clf", scanRow("10") + scanRow("11", "81.91"));
  EXPECT_EQ(convert(log, "--max-range 1000"), 0);
  EXPECT_THAT(
      err, HasSubstr("a SICK laser in 80 m mode reports for no return: " + log + "; --max-range 80 drops"));
  EXPECT_EQ(convert(log, "--max-range 0.05"), 0);
  EXPECT_EQ(err, "log2rawlog: warning: 362 of 362 readings are at or beyond 0.05 m: " + log +
                     "; --max-range makes them no returns\n");
  for (const char* option : {"", "--max-range 80", "--max-range 3"}) {
    EXPECT_EQ(convert(log, option), 0);
    EXPECT_EQ(err, "") << option;
  }
}

TEST_F(Log2Rawlog, WarnsOfTheEightMetreMode) {
  const std::string log = folder.write("in.clf", scanRow("10", "8.183") + scanRow("11") + scanRow("12"));
  EXPECT_EQ(convert(log), 0);
  EXPECT_THAT(err, HasSubstr("--max-range 8.18 drops them"));
  EXPECT_EQ(convert(log, "--max-range 8.18"), 0);
  EXPECT_THAT(err, IsEmpty());
}

TEST_F(Log2Rawlog, ConvertsAnInstalledLog) {
  const test::InstalledProgram installed(folder, LOG2RAWLOG);
  std::ofstream(installed.data("robot.clf")) << odometryRow("100", "0") + scanRow("100");
  const test::Outcome outcome =
      test::shell(folder, "'" + installed.path + "' data/robot.clf '" + rawlog + "'");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(entries(), 3u);
}

TEST_F(Log2Rawlog, HelpAndVersion) {
  EXPECT_EQ(run("--help"), 0);
  for (const char* option : {"--format", "--time", "--period", "--max-range", "--angular-step", "--laser-x",
                             "--scan-time", "--scan-rate", "--action-observation", "--strict", "--version"})
    EXPECT_THAT(out, HasSubstr(option));
  for (const char* range : {"80", "8.18", "5.6"}) EXPECT_THAT(out, HasSubstr(range)) << "of --max-range";
  EXPECT_EQ(run("--version"), 0);
  EXPECT_THAT(out, MatchesRegex("log2rawlog [0-9]+[.][0-9]+[.][0-9]+\n"));
}

TEST_F(Log2Rawlog, WrongCommandLine) {
  const std::string log = folder.write("in.clf", scanRow("10"));
  expectError(run(""), "input is required");
  expectError(run("'" + log + "'"), "output is required");
  expectError(convert(log, "--frmat carmen"), "");
  expectError(convert(log, "--format clf"), "clf");
  expectError(convert(log, "--time now"), "now");
  expectError(convert(log, "--max-range -1"), "-1");
  expectError(convert(log, "--angular-step x"), "angular-step");
  expectError(convert(log, "--period 0"), "period");
  expectError(convert(log, "--laser-x nan"), "laser-x");
  expectError(convert(log, "--scan-time 1.5"), "scan-time");
  expectError(convert(log, "--scan-rate 0"), "scan-rate");
  expectError(convert(log, "--scan-time 0.02 --scan-rate 25"), "excludes");
}

TEST_F(Log2Rawlog, WrongInput) {
  expectError(convert(folder.path("none")), "no such file: " + folder.path("none") + "; expected");
  expectError(convert(folder.path("")), "a folder, not a file");
  expectError(convert(folder.write("empty", "")), "not a robot log");
  expectError(convert(folder.write("text", "once upon\na time\n")), "not a robot log");
  expectError(convert(LOG2RAWLOG), "not a");
  expectError(convert(folder.write("odometry", "ODOM 1 2 3 0 0 0 5 host 6\n")), "no laser scan");
}

TEST_F(Log2Rawlog, CutCompressedLogs) {
  std::string log;
  for (int i = 0; i < 2000; ++i) log += scanRow(std::to_string(i), std::to_string(1 + i % 37));
  for (const files::Compression compression : test::kCompressions) {
    SCOPED_TRACE(files::nameOf(compression));
    const std::string bytes = test::compressed(compression, log);
    const std::string cut = folder.write("cut", bytes.substr(0, bytes.size() / 2));
    // The last readable line may be broken and is then reported first.
    EXPECT_EQ(convert(cut), 2);
    EXPECT_THAT(err, HasSubstr("log2rawlog: error: " + std::string(files::nameOf(compression)) +
                               " file cut off: " + cut + ", after line "));
    EXPECT_FALSE(fs::exists(rawlog));
    EXPECT_FALSE(fs::exists(folder.path(".partial.out.rawlog")));
  }
}

TEST_F(Log2RawlogAsUser, UnreadableInput) {
  const std::string log = folder.write("in.clf", scanRow("10"));
  fs::permissions(log, fs::perms::none);
  if (access(log.c_str(), R_OK) == 0) GTEST_SKIP() << "run as root, who can read everything";
  expectError(convert(log), "cannot read");
}

TEST_F(Log2Rawlog, OutputThatCannotBeWritten) {
  const std::string log = folder.write("in.clf", scanRow("10"));
  rawlog = folder.path("none/out.rawlog");
  expectError(convert(log), "cannot write: " + rawlog);
  EXPECT_EQ(run("'" + log + "' '" + folder.path("") + "'"), 2);
  EXPECT_THAT(err, HasSubstr("expected a file name"));
  EXPECT_EQ(run("'" + log + "' '" + log + "'"), 2);
  EXPECT_THAT(err, HasSubstr("the output is the input"));
  EXPECT_EQ(test::contentOf(log), scanRow("10"));
}

/// A file size limit simulates a full disk: writing fails in the middle.
TEST_F(Log2Rawlog, ALinkStaysAndItsFileGetsTheRawlog) {
  const std::string path = folder.write("in.clf", scanRow("1") + scanRow("2")),
                    real = folder.write("real.rawlog", "");
  fs::create_symlink(real, rawlog);
  EXPECT_EQ(convert(path), 0) << err;
  EXPECT_TRUE(fs::is_symlink(rawlog));
  EXPECT_EQ(fs::read_symlink(rawlog), real);
  EXPECT_GT(fs::file_size(real), 0u);
}

// A killed hybrid-slam-live leaves its recording under the name that a rawlog has until it is complete.
TEST_F(Log2Rawlog, ConvertsTheRecordingOfAKilledRunToItsFinalName) {
  ASSERT_EQ(convert(folder.write("in.clf", scanRow("1") + scanRow("2"))), 0) << err;
  const std::string left = folder.path(".partial.recording.rawlog"), recorded = test::contentOf(rawlog);
  fs::rename(rawlog, left);
  rawlog = folder.path("recording.rawlog");
  EXPECT_EQ(convert(left), 0) << err;
  EXPECT_EQ(test::contentOf(left), recorded);
  EXPECT_TRUE(fs::exists(rawlog));
}

TEST_F(Log2Rawlog, DiskFull) {
  std::string log;
  for (int i = 0; i < 3000; ++i) {
    std::string row = scanRow(std::to_string(i));
    for (size_t at = row.find("2.5"), k = 1; at != std::string::npos; at = row.find("2.5", at + 3), ++k)
      row[at + 2] = static_cast<char>('0' + (static_cast<size_t>(i) * k * k % 101) % 10);
    log += row;
  }
  const std::string path = folder.write("in.clf", log);
  ASSERT_EQ(convert(path), 0);
  ASSERT_GT(fs::file_size(rawlog), 40000u);
  fs::remove(rawlog);
  EXPECT_EQ(convert(path, "", "trap '' XFSZ; ulimit -f 20; "), 1);
  EXPECT_THAT(err, testing::StartsWith("log2rawlog: error: cannot write: " + rawlog));
  EXPECT_FALSE(fs::exists(rawlog));
  EXPECT_FALSE(fs::exists(folder.path(".partial.out.rawlog")));
}

}  // namespace
}  // namespace hybrid_slam
