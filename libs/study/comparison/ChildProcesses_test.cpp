#include "study/comparison/ChildProcesses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <map>
#include <thread>

#include "files/TemporaryFolder.h"
#include "testing/Happens.h"

namespace hybrid_slam::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

struct ChildProcessesTest : testing::Test {
  files::TemporaryFolder folder;
  std::atomic<bool> stop{false};
  std::map<size_t, std::string> ends;
  size_t running = 0, most = 0;

  bool run(const std::vector<std::string>& scripts, size_t atOnce) {
    std::vector<ChildCommand> commands;
    for (const std::string& script : scripts)
      commands.push_back({{"sh", "-c", script}, folder.path("messages" + std::to_string(commands.size()))});
    return runAll(commands, atOnce);
  }
  bool runAll(const std::vector<ChildCommand>& commands, size_t atOnce) {
    return runCommands(
        commands, atOnce, stop, [&](size_t) { most = std::max(most, ++running); },
        [&](size_t i, const std::string& error) {
          --running;
          ends[i] = error;
        });
  }
};

TEST_F(ChildProcessesTest, ReportsHowEachEnded) {
  EXPECT_TRUE(run({"exit 0", "echo 'prog: error: no such file: x; expected y' >&2; echo more >&2; exit 2",
                   "exit 3", "kill -9 $$", "echo first >&2; echo last >&2; exit 1", "echo warning >&2"},
                  2));
  EXPECT_THAT(ends, ElementsAre(Pair(0, ""), Pair(1, "no such file: x; expected y"), Pair(2, "exit status 3"),
                                Pair(3, "ended by signal 9"), Pair(4, "last"), Pair(5, "")));
}

TEST_F(ChildProcessesTest, RunsAtMostTheGivenNumberAtOnce) {
  run(std::vector<std::string>(7, "exit 0"), 3);
  EXPECT_EQ(ends.size(), 7u);
  EXPECT_EQ(most, 3u);
}

TEST_F(ChildProcessesTest, AMissingProgramIsAFailedCommand) {
  runAll({{{"/nowhere/hybrid-slam"}, folder.path("messages")}}, 1);
  EXPECT_THAT(ends.at(0), HasSubstr("cannot be started"));
}

TEST_F(ChildProcessesTest, StoppingEndsTheChildrenAndStartsNoMore) {
  const std::string pidFile = folder.path("pid");
  std::thread stopper([&] {
    EXPECT_TRUE(test::happens([&] {
      std::ifstream in(pidFile);
      std::string line;
      return std::getline(in, line) && !in.eof();
    }));
    stop = true;
  });
  EXPECT_FALSE(run({"echo $$ > " + pidFile + "; exec sleep 1000", "exit 0"}, 1));
  stopper.join();
  EXPECT_TRUE(ends.empty());
  pid_t child = 0;
  std::ifstream(pidFile) >> child;
  ASSERT_GT(child, 1);
  EXPECT_EQ(kill(child, 0), -1);
}

/// If a program is started with SIGCHLD ignored, the system keeps no exit status.
TEST_F(ChildProcessesTest, AnUnknownExitStatusIsAFailure) {
  const auto before = signal(SIGCHLD, SIG_IGN);
  EXPECT_TRUE(run({"exit 3"}, 1));
  signal(SIGCHLD, before);
  EXPECT_THAT(ends, ElementsAre(Pair(0, HasSubstr("No child processes"))));
}

TEST_F(ChildProcessesTest, AnEmptyListOfCommandsSucceeds) { EXPECT_TRUE(run({}, 2)); }

}  // namespace
}  // namespace hybrid_slam::comparison
