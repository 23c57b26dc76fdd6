/// Results that cannot be written; terminal, signals and memory of the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

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
using testing::StartsWith;
using testing::UnorderedElementsAreArray;

// ---- output

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

TEST_F(HybridSlam, AResultThatCannotBeWrittenLeavesNoPartialFile) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4));
  for (const std::string& name : kResults) {
    SCOPED_TRACE(name);
    fs::remove_all(output);
    fs::create_directories(output + "/" + name);
    EXPECT_EQ(replay(log), 2);
    EXPECT_EQ(err, "hybrid-slam: error: cannot write: " + output + "/" + name + "; expected a file name\n");
    for (const std::string& left : results()) EXPECT_THAT(kResults, testing::Contains(left));
  }
}

/// A file size limit simulates a full disk: writing fails in the middle of a result.
TEST_F(HybridSlam, DiskFull) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(40));
  ASSERT_EQ(replay(log), 0);
  std::map<std::string, std::string> complete;
  for (const std::string& name : results()) complete[name] = result(name);
  const auto largest = fs::file_size(output + "/map.png");
  std::set<std::string> failures;
  for (std::uintmax_t blocks = 1; blocks * 512 < largest; blocks *= 2) {
    SCOPED_TRACE(blocks);
    fs::remove_all(output);
    EXPECT_EQ(replay(log, "", "trap '' XFSZ; ulimit -f " + std::to_string(blocks) + "; "), 2);
    EXPECT_THAT(err, MatchesRegex(kErrorLine));
    EXPECT_THAT(err, AllOf(StartsWith("hybrid-slam: error: cannot write: " + output + "/"),
                           HasSubstr("free disk space")));
    failures.insert(err);
    for (const std::string& name : results()) EXPECT_EQ(result(name), complete.at(name)) << name;
  }
  EXPECT_GE(failures.size(), 2u) << "of several files";
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
  test::Log log = test::laps(100);
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  const auto [text, code] = onTerminal({"hybrid-slam", "-o", output, ini, path});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, HasSubstr("\r[##############################] 100 %  0:00 left  spread "));
  EXPECT_THAT(text, HasSubstr("\n100 scans, ")) << "the bar's line is ended";

  std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(log[log.size() - 2])->odometry.x(1000);
  ini = folder.write("every.ini",
                     "[particle_filter]\nproposal = standard\nupdate_distance = 0\nparticles = 300\n");
  const auto [error, errorCode] =
      onTerminal({"hybrid-slam", "-o", output, ini, test::writeGzipped(path, log)});
  EXPECT_EQ(errorCode, 2);
  EXPECT_THAT(error, HasSubstr("\nhybrid-slam: error: odometry jumps")) << "also by an error";
}

TEST_F(HybridSlam, CtrlCWritesTheResultsSoFar) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(4000));
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove_all(output);
    test::ChildProgram program(folder, "run", {HYBRID_SLAM, "-q", "-n", "300", "-o", output, ini, log});
    const std::string steps = output + "/.partial.steps.csv";  // its first rows come in one block
    EXPECT_TRUE(test::happens([&] {
      std::error_code none;
      return program.hasEnded() || (fs::file_size(steps, none) > 0 && !none);
    }));
    program.signal(signal);
    EXPECT_EQ(program.wait(), 1);
    err = program.err();
    EXPECT_THAT(err, MatchesRegex(kErrorLine));
    EXPECT_THAT(err, HasSubstr("interrupted: entry "));
    EXPECT_THAT(results(), UnorderedElementsAreArray(kResults));
    EXPECT_LT(files::loadTum(output + "/trajectory.tum").size(), 4000u);
  }
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
