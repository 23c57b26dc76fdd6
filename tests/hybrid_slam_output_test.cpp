/// Results that cannot be written; terminal and signals of the program.
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
#include "testing/Happens.h"

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

struct HybridSlamOutput : HybridSlam {};
using HybridSlamOutputAsUser = HybridSlamOutput;  // skipped as root, apart from the others

// ---- output

/// config.ini and a session hold the names as text of an INI file.
TEST_F(HybridSlamOutput, NamesThatAnIniFileCannotHold) {
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

TEST_F(HybridSlamOutput, OutputThatCannotBeWritten) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  output = folder.write("file", "in its place");
  expectError(replay(log), output);
  EXPECT_EQ(test::contentOf(output), "in its place");
  output += "/below";
  expectError(replay(log), output);
}

TEST_F(HybridSlamOutputAsUser, OutputFolderNotWritable) {
  fs::create_directory(output);
  fs::permissions(output, fs::perms::owner_read | fs::perms::owner_exec);
  if (access(output.c_str(), W_OK) == 0) GTEST_SKIP() << "run as root, who can write everywhere";
  expectError(replay(test::laps(4)), "output folder not writable: " + output);
}

TEST_F(HybridSlamOutput, AResultThatCannotBeReplacedLeavesNoOtherFile) {
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
TEST_F(HybridSlamOutput, DiskFull) {
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

TEST_F(HybridSlamOutput, ASecondRunLeavesTheResultsOfTheFirst) {
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

TEST_F(HybridSlamOutput, AFailedRunLeavesTheResultsOfTheOneBefore) {
  ASSERT_EQ(replay(test::laps(10)), 0);
  const std::string first = result("metrics.json");
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  EXPECT_EQ(replay(log, "", "trap '' XFSZ; ulimit -f 2; "), 1);
  EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
  EXPECT_EQ(result("metrics.json"), first);
}

TEST_F(HybridSlamOutput, AFullStandardOutputIsAnError) {
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
TEST_F(HybridSlamOutput, AClosedPipeIsAnErrorAfterTheResults) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  const test::Outcome piped = test::shell(
      folder, "{ '" HYBRID_SLAM "' '" + log + "' -o out; echo $? >code; } | true; sleep 0.1; true");
  for (int i = 0; i < 100 && !fs::exists(folder.path("code")); ++i) test::shell(folder, "sleep 0.1");
  EXPECT_EQ(contentOf(folder.path("code")), "1\n");
  EXPECT_THAT(test::namesIn(folder.path("out")), UnorderedElementsAreArray(kResults));
  EXPECT_THAT(piped.err, Not(HasSubstr("terminate")));
}

/// Without a trap, SIGXFSZ ends a program that does not ignore it.
TEST_F(HybridSlamOutput, ALimitOfTheFileSizeIsAnError) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  EXPECT_EQ(replay(log, "", "ulimit -f 2; "), 1);
  EXPECT_THAT(err, HasSubstr("hybrid-slam: error: "));
  EXPECT_THAT(results(), IsEmpty());
}

/// A result file must not get the descriptor of standard error, and with it the messages.
TEST_F(HybridSlamOutput, ClosedStandardDescriptorsHarmNoResult) {
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

TEST_F(HybridSlamOutput, ATerminalShowsABarWithTheTimeLeft) {
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), test::laps(100));
  const auto [text, code] = onTerminal({"hybrid-slam", "-o", output, ini, path});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, HasSubstr("\r[##############################] 100 %  0:00 left  spread "));
  EXPECT_THAT(text, HasSubstr("\n100 scans, ")) << "the bar's line is ended";
}

TEST_F(HybridSlamOutput, OverwritingRemovesParticlesOfTheEarlierRun) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  ASSERT_EQ(replay(log, "--set run.particles_every=1"), 0);
  EXPECT_TRUE(fs::exists(output + "/particles.csv"));
  ASSERT_EQ(replay(log, "--overwrite"), 0);
  EXPECT_FALSE(fs::exists(output + "/particles.csv"));
}

TEST_F(HybridSlamOutput, ATerminalShowsTheManualWithoutMarkdown) {
  const auto [text, code] = onTerminal({"hybrid-slam", "--help-config"});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, AllOf(HasSubstr("\r\n[particle_filter]\r\n"),
                          HasSubstr("  (0..100000)\r\n      number of particles; 0: adaptive")));
  for (const char* markdown : {"|---", "## ", "&#124;"}) EXPECT_EQ(text.find(markdown), std::string::npos);
}

TEST_F(HybridSlamOutput, CtrlCWritesTheResultsSoFar) {
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

TEST_F(HybridSlamOutput, KilledAtAnyTimeTheFolderHasTheResultsOfOneRun) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(20));
  ASSERT_EQ(replay(log), 0);
  std::ofstream(output + "/notes") << "mine";
  auto expected = kResults;
  expected.emplace_back("notes");
  const auto unfinished = [&] { return test::filesIn(folder.path(""), ".out.part-"); };
  for (int i = 0; i < 15; ++i) {
    SCOPED_TRACE(i);
    const auto left = unfinished();
    const std::string before = result("metrics.json"), trajectory = result("trajectory.tum");
    {
      test::ChildProgram program(
          folder, "run", {HYBRID_SLAM, "-q", "--overwrite", "-s", std::to_string(i), "-o", output, ini, log});
      ASSERT_TRUE(test::happens([&] { return unfinished() != left; })) << "the program has begun";
      std::this_thread::sleep_for(std::chrono::milliseconds(10 * i));
    }  // killed
    EXPECT_THAT(results(), UnorderedElementsAreArray(expected));
    const auto metrics = nlohmann::json::parse(result("metrics.json"), nullptr, false);
    EXPECT_EQ(metrics["complete"], true);
    EXPECT_EQ(result("metrics.json") == before, result("trajectory.tum") == trajectory);
  }
  ASSERT_EQ(replay(log), 0);
  for (const std::string& left : unfinished())
    EXPECT_TRUE(fs::exists(left + "/metrics.json")) << "unfinished results are cleared away by the last run";
}

TEST_F(HybridSlamOutput, ARunUnderNohupOutlivesItsTerminal) {
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

}  // namespace
}  // namespace hybrid_slam
