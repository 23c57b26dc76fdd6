/// Results that cannot be written; terminal, signals and memory of the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>

#include "ChildProgram.h"
#include "HybridSlamProgram.h"
#include "files/Trajectory.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::kResults;
using test::Log;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAreArray;

// ---- output

/// config.ini and a session hold the names as text of an INI file.
TEST_F(HybridSlam, NamesThatAnIniFileCannotHold) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  for (const std::string name : {"out ", " out", "a // b"}) {
    output = folder.path(".") + "/" + name;
    if (name[0] == ' ') output = name;
    expectError(replay(log), "wrong name `" + output + "`");
  }
  output = "out\n[grid]\nresolution = 1";
  expectError(replay(log), "line break in a setting");
  output = folder.path("out");
  expectError(replay(log, "--set 'grid.resolution=0.05\r'"), "line break in a setting");
  const std::string broken = folder.path("l\nog.rawlog");
  fs::copy_file(log, broken);
  expectError(replay(broken), "line break in a setting");
}

TEST_F(HybridSlam, OutputThatCannotBeWritten) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  output = folder.write("file", "in its place");
  expectError(replay(log), output);
  EXPECT_EQ(test::contentOf(output), "in its place");
  output += "/below";
  expectError(replay(log), output);
}

TEST_F(HybridSlam, OutputFolderNotWritable) {
  fs::create_directory(output);
  fs::permissions(output, fs::perms::owner_read | fs::perms::owner_exec);
  if (access(output.c_str(), W_OK) == 0) GTEST_SKIP() << "run as root, who can write everywhere";
  expectError(replay(test::laps(4)), "output folder not writable: " + output);
}

TEST_F(HybridSlam, AResultThatCannotBeReplacedLeavesNoOtherFile) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  for (const std::string& name : kResults) {
    SCOPED_TRACE(name);
    fs::remove_all(output);
    fs::create_directories(output + "/" + name);
    EXPECT_EQ(replay(log), 2);
    EXPECT_EQ(err, "hybrid-slam: error: cannot write: " + output + "/" + name + "; expected a file name\n");
    EXPECT_THAT(results(), testing::ElementsAre(name));
  }
}

/// A file size limit simulates a full disk: writing fails in the middle of a result.
TEST_F(HybridSlam, DiskFull) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  ASSERT_EQ(replay(log), 0);
  const auto largest = fs::file_size(output + "/map.png");
  std::set<std::string> failures;
  for (std::uintmax_t blocks = 1; blocks * 512 < largest; blocks *= 2) {
    SCOPED_TRACE(blocks);
    fs::remove_all(output);
    EXPECT_EQ(replay(log, "", "trap '' XFSZ; ulimit -f " + std::to_string(blocks) + "; "), 1);
    EXPECT_THAT(err, MatchesRegex(kErrorLine));
    EXPECT_THAT(err, AllOf(StartsWith("hybrid-slam: error: cannot write: " + folder.path(".out.part-")),
                           HasSubstr("free disk space")));
    failures.insert(err.substr(0, err.find(';')).substr(err.rfind('/')));
    EXPECT_FALSE(fs::exists(output));
  }
  EXPECT_GE(failures.size(), 2u) << "of several files";
}

TEST_F(HybridSlam, ASecondRunLeavesTheResultsOfTheFirst) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  const std::string call = "'" + ini + "' '" + log + "' -o '" + output + "'";
  ASSERT_EQ(run(call), 0) << err;
  EXPECT_EQ(err, "");
  const std::string first = result("metrics.json");
  for (const size_t more : {1u, 2u}) {
    ASSERT_EQ(run(call), 0) << err;
    EXPECT_THAT(err, MatchesRegex(output + " has results of an earlier run; those of this run go to " +
                                  output + "/20[^ ]* \\(--overwrite[^\n]*\n"));
    const std::string place = err.substr(err.find(output + "/20"), err.find(" (") - err.find(output + "/20"));
    EXPECT_THAT(test::namesIn(place), UnorderedElementsAreArray(kResults));
    EXPECT_THAT(out, HasSubstr(place + "/map.png"));
    EXPECT_EQ(results().size(), kResults.size() + more);
  }
  EXPECT_EQ(result("metrics.json"), first);
  ASSERT_EQ(run(call + " --overwrite"), 0) << err;
  EXPECT_EQ(err, "");
  EXPECT_NE(result("metrics.json"), first);
  EXPECT_EQ(results().size(), kResults.size() + 2);
}

TEST_F(HybridSlam, AFailedRunLeavesTheResultsOfTheOneBefore) {
  ASSERT_EQ(replay(test::laps(10)), 0);
  const std::string first = result("metrics.json");
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  EXPECT_EQ(replay(log, "", "trap '' XFSZ; ulimit -f 2; "), 1);
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
  EXPECT_EQ(result("metrics.json"), first);
}

TEST_F(HybridSlam, AFullStandardOutputIsAnError) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  for (const std::string& arguments :
       {std::string("--help-config"), std::string("--help"), "'" + log + "' -o out"}) {
    const test::Outcome full =
        test::shell(folder, "{ '" HYBRID_SLAM "' " + arguments + " >/dev/full; echo $? >code; }");
    EXPECT_EQ(contentOf(folder.path("code")), "1\n") << arguments;
    EXPECT_THAT(full.err, HasSubstr("hybrid-slam: error: cannot write: standard output; ")) << arguments;
  }
}

/// `| less`, then `q`: the run goes on to its results.
TEST_F(HybridSlam, AClosedPipeIsAnErrorAfterTheResults) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  const test::Outcome piped = test::shell(
      folder, "{ '" HYBRID_SLAM "' '" + log + "' -o out; echo $? >code; } | true; sleep 0.1; true");
  for (int i = 0; i < 100 && !fs::exists(folder.path("code")); ++i) test::shell(folder, "sleep 0.1");
  EXPECT_EQ(contentOf(folder.path("code")), "1\n");
  EXPECT_THAT(test::namesIn(folder.path("out")), UnorderedElementsAreArray(kResults));
  EXPECT_THAT(piped.err, Not(HasSubstr("terminate")));
}

/// Without a trap, SIGXFSZ ends a program that does not ignore it.
TEST_F(HybridSlam, ALimitOfTheFileSizeIsAnError) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  EXPECT_EQ(replay(log, "", "ulimit -f 2; "), 1);
  EXPECT_THAT(err, HasSubstr("hybrid-slam: error: "));
  EXPECT_THAT(results(), IsEmpty());
}

/// A result file must not get the descriptor of standard error, and with it the messages.
TEST_F(HybridSlam, ClosedStandardDescriptorsHarmNoResult) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  ASSERT_EQ(run("'" + ini + "' '" + log + "' -o '" + output + "'"), 0);
  const std::string expected = result("trajectory.tum");
  test::shell(folder,
              "('" HYBRID_SLAM "' '" + ini + "' '" + log + "' -o closed <&- >&- 2>&-; echo $? >code); true");
  EXPECT_EQ(contentOf(folder.path("code")), "0\n");
  EXPECT_THAT(test::namesIn(folder.path("closed")), UnorderedElementsAreArray(kResults));
  EXPECT_EQ(contentOf(folder.path("closed/trajectory.tum")), expected);
}

// ---- processes

std::vector<char*> pointersTo(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  return argv;
}

/// The program's output on a terminal, and its exit code.
std::pair<std::string, int> onTerminal(const std::vector<std::string>& arguments) {
  int terminal = 0;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execv(HYBRID_SLAM, pointersTo(arguments).data());
    _exit(127);
  }
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(terminal, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<size_t>(n));
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  return {text, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

TEST_F(HybridSlam, ATerminalShowsABarWithTheTimeLeft) {
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), test::laps(100));
  const auto [text, code] = onTerminal({"hybrid-slam", "-o", output, ini, path});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, HasSubstr("\r[##############################] 100 %  0:00 left  spread "));
  EXPECT_THAT(text, HasSubstr("\n100 scans, ")) << "the bar's line is ended";
}

TEST_F(HybridSlam, OverwritingRemovesParticlesOfTheEarlierRun) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  ASSERT_EQ(replay(log, "--set run.particles_every=1"), 0);
  EXPECT_TRUE(fs::exists(output + "/particles.csv"));
  ASSERT_EQ(replay(log, "--overwrite"), 0);
  EXPECT_FALSE(fs::exists(output + "/particles.csv"));
}

TEST_F(HybridSlam, ATerminalShowsTheManualWithoutMarkdown) {
  const auto [text, code] = onTerminal({"hybrid-slam", "--help-config"});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, AllOf(HasSubstr("\r\n[particle_filter]\r\n"),
                          HasSubstr("  (0..100000)\r\n      number of particles; 0: adaptive")));
  for (const char* markdown : {"|---", "## ", "&#124;"}) EXPECT_EQ(text.find(markdown), std::string::npos);
}

TEST_F(HybridSlam, CtrlCWritesTheResultsSoFar) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4000));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::optional<test::ChildProgram> program;
    std::chrono::steady_clock::duration between;
    do {
      program.reset();
      fs::remove_all(output);
      program.emplace(folder, "run",
                      std::vector<std::string>{HYBRID_SLAM, "-q", "-n", "300", "--checkpoint-every", "0.1",
                                               "-o", output, ini, log});
      EXPECT_TRUE(
          test::happens([&] { return program->hasEnded() || fs::exists(output + "/session.hslam"); }));
      const auto before = std::chrono::steady_clock::now();
      program->signal(signal);  // `timeout`, supervisors and closing terminals signal twice
      program->signal(signal == SIGTERM ? SIGINT : SIGTERM);  // two of a kind may arrive as one
      between = std::chrono::steady_clock::now() - before;
    } while (between > std::chrono::milliseconds(400));  // after a stall, the second kills
    EXPECT_EQ(program->wait(), 1);
    err = program->err();
    EXPECT_THAT(err, MatchesRegex(kErrorLine));
    EXPECT_THAT(err, HasSubstr("interrupted: entry "));
    EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
    const size_t scans = files::loadTum(output + "/trajectory.tum").size();
    EXPECT_LT(scans, 4000u);
    const auto metrics = nlohmann::json::parse(result("metrics.json"));
    EXPECT_EQ(metrics["complete"], false);
    EXPECT_NEAR(metrics["duration_s"].get<double>(), 0.2 * static_cast<double>(scans - 1), 1e-3)
        << "of the scans that were replayed";
  }
}

TEST_F(HybridSlam, KilledAtAnyTimeTheFolderHasTheResultsOfOneRun) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(20));
  ASSERT_EQ(replay(log), 0);
  std::ofstream(output + "/notes") << "mine";
  auto expected = kResults;
  expected.emplace_back("notes");
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    const std::string before = result("metrics.json"), trajectory = result("trajectory.tum");
    {
      test::ChildProgram program(
          folder, "run", {HYBRID_SLAM, "-q", "--overwrite", "-s", std::to_string(i), "-o", output, ini, log});
      std::this_thread::sleep_for(std::chrono::milliseconds(20 * i));
    }  // killed
    EXPECT_THAT(results(), UnorderedElementsAreArray(expected));
    const auto metrics = nlohmann::json::parse(result("metrics.json"), nullptr, false);
    EXPECT_EQ(metrics["complete"], true);
    EXPECT_EQ(result("metrics.json") == before, result("trajectory.tum") == trajectory);
  }
  ASSERT_EQ(replay(log), 0);
  for (const std::string& left : test::filesIn(folder.path(""), ".out.part-"))
    EXPECT_TRUE(fs::exists(left + "/metrics.json")) << "unfinished results are cleared away by the last run";
}

TEST_F(HybridSlam, WhereTheMapsOfMrptsFilterFillTheMemoryTheResultsEndThere) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need their address space";
#endif
  test::Log log;
  for (int i = 0; i < 60; ++i) {  // 40 m steps to the north-east
    log.push_back(test::odometry(1000 + i, {28. * i, 28. * i, 0}));
    log.push_back(test::scan(1000 + i));
  }
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  test::ChildProgram program(folder, "run",
                             {"/bin/sh", "-c",
                              "ulimit -v 1400000; exec '" HYBRID_SLAM "' -q -m stock -n 5 -o '" + output +
                                  "' '" + ini + "' '" + path + "' --set motion_model.turn_var_d=0"});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(),
              HasSubstr("run failed: maps of 5 particles too large for MRPT's filter: over 0.7 GB"));
  EXPECT_THAT(program.err(), HasSubstr("results cover the log up to this point"));
  EXPECT_TRUE(fs::exists(output + "/map.png"));
  EXPECT_GT(files::loadTum(output + "/trajectory.tum").size(), 5u);
  EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["complete"], false);
}

/// A map of 1 km by 1 km, with a limit between what the filter needs and what the largest result needs.
TEST_F(HybridSlam, AResultThatNeedsTooMuchMemoryDoesNotCostTheOthers) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need their address space";
#endif
  test::Log log;
  for (int i = 0; i < 60; ++i) {  // 20 m steps to the north-east
    log.push_back(test::odometry(1000 + 20 * i, {14. * i, 14. * i, 0}));
    log.push_back(test::scan(1000 + 20 * i));
  }
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  size_t incomplete = 0;
  for (const int megabytes : {450, 500, 550, 600, 700, 800}) {
    SCOPED_TRACE(megabytes);
    std::filesystem::remove_all(output);
    test::ChildProgram program(
        folder, "run",
        {"/bin/sh", "-c",
         "ulimit -v " + std::to_string(1024 * megabytes) + "; exec '" HYBRID_SLAM "' -q -n 5 -o '" + output +
             "' '" + ini + "' '" + path + "'"});
    const int status = program.wait();
    if (!fs::exists(output + "/metrics.json")) continue;  // not even the filter had room
    EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 60u);
    const bool isComplete = nlohmann::json::parse(result("metrics.json"))["complete"];
    EXPECT_EQ(isComplete, status == 0);
    incomplete += !isComplete;
    EXPECT_EQ(isComplete, program.err().find("out of memory") == std::string::npos) << program.err();
  }
  EXPECT_GT(incomplete, 0u);
}

/// The limit is reached while mapping; there may be no room for the grid of the results either.
TEST_F(HybridSlam, WhereTheMemoryEndsThereAreResults) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need their address space";
#endif
  test::Log log;
  for (int i = 0; i < 30; ++i) {  // 85 m steps to the north-east
    log.push_back(test::odometry(1000 + 0.2 * i, {60. * i, 60. * i, 0}));
    log.push_back(test::scan(1000 + 0.2 * i));
  }
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  for (const int megabytes : {560, 600, 640}) {
    SCOPED_TRACE(megabytes);
    fs::remove_all(output);
    test::ChildProgram program(
        folder, "run",
        {"/bin/sh", "-c",
         "ulimit -v " + std::to_string(1024 * megabytes) + "; exec '" HYBRID_SLAM "' -q -o '" + output +
             "' '" + path + "' --set grid.resolution=0.02"});
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(program.err(), HasSubstr("results cover the log up to this point"));
    EXPECT_FALSE(files::loadTum(output + "/trajectory.tum").empty());
  }
}

TEST_F(HybridSlam, ARunUnderNohupOutlivesItsTerminal) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(400));
  test::ChildProgram program(
      folder, "run",
      {"/bin/sh", "-c",
       "trap '' HUP; exec '" HYBRID_SLAM "' -q -n 50 -o '" + output + "' '" + ini + "' '" + log + "'"});
  EXPECT_TRUE(test::happens([&] { return fs::exists(output); }));
  program.signal(SIGHUP);
  EXPECT_EQ(program.wait(), 0) << program.err();
  EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["complete"], true);
}

TEST_F(HybridSlam, PeakMemoryIsThatOfTheProgramAlone) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  {
    const std::vector<char> large(700 << 20, 'x');  // resident in the process that starts it
    ASSERT_EQ(large.back(), 'x');
    test::ChildProgram program(folder, "run", {HYBRID_SLAM, "-q", "-o", output, ini, log});
    EXPECT_EQ(program.wait(), 0);
  }
  EXPECT_LT(nlohmann::json::parse(result("metrics.json"))["peak_rss_mb"], 700);
}

TEST_F(HybridSlam, MemoryDoesNotGrowWithTheLogOfTheSamePlace) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer keeps freed memory";
#endif
  const auto peakOf = [this](size_t steps) {
    EXPECT_EQ(replay(test::laps(steps), "-q -n 20"), 0) << err;
    return nlohmann::json::parse(result("metrics.json"))["peak_rss_mb"].get<double>();
  };
  const double once = peakOf(800), twice = peakOf(1600);
  EXPECT_LT(twice, 1.1 * once) << once << " MB, then " << twice << " MB";
  RecordProperty("peak_rss_mb", std::to_string(once) + ", " + std::to_string(twice));
}

}  // namespace
}  // namespace hybrid_slam
