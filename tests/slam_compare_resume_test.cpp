/// Comparisons of slam-compare that continue earlier ones: interrupted, damaged, extended, made elsewhere.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "ChildProgram.h"
#include "SlamCompareProgram.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct SlamCompareResume : SlamCompare {};

TEST_F(SlamCompareResume, InterruptedAndResumedGivesTheSameTable) {
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

/// The relations are a pipe, so that the program is outside the runs until the pipe is closed.
TEST_F(SlamCompareResume, CtrlCOutsideTheRunsEndsIt) {
  const std::string pipe = folder.path("relations"), relation = "1 2 1 0 0 0 0 0\n";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const int second : {SIGHUP, SIGINT}) {
    SCOPED_TRACE(second);
    test::ChildProgram program(
        folder, "stopped", {SLAM_COMPARE, config, kLog, "-o", folder.path("out"), "--relations", pipe, "-q"});
    int writer = -1;
    EXPECT_TRUE(test::happens([&] {
      writer = ::open(pipe.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
      return writer >= 0 || program.hasEnded();
    }));
    ASSERT_GE(writer, 0) << program.err();
    EXPECT_EQ(::write(writer, relation.data(), relation.size()), static_cast<ssize_t>(relation.size()));
    program.signal(SIGINT);
    if (second == SIGINT) {
      EXPECT_TRUE(test::happens([&] {  // those within half a second count as one
        program.signal(second);
        return program.hasEnded();
      }));
      EXPECT_EQ(program.endedBySignal(), SIGINT);
      ::close(writer);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(600));
      program.signal(second);
      ::close(writer);
      EXPECT_EQ(program.wait(), 1);
      EXPECT_EQ(program.err(),
                "slam-compare: error: interrupted: entry 1 of " + kLog + "; the same command continues\n");
    }
    EXPECT_FALSE(fs::exists(folder.path("out")));
  }
}

TEST_F(SlamCompareResume, ADamagedRunIsRunAgain) {
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

TEST_F(SlamCompareResume, MoreSeedsKeepExistingRuns) {
  ASSERT_EQ(run("--methods general --seeds 1 -q").status, 0);
  const auto before = fs::last_write_time(folder.path("out/runs/general-3-1/metrics.json"));
  ASSERT_EQ(run("--methods general --seeds 2 -q").status, 0);
  EXPECT_EQ(table("results.csv").size(), 2u);
  EXPECT_EQ(fs::last_write_time(folder.path("out/runs/general-3-1/metrics.json")), before);
}

TEST_F(SlamCompareResume, AFinishedRunOfAnotherComparisonIsAnError) {
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

TEST_F(SlamCompareResume, ReportOnlyStartsNothing) {
  EXPECT_THAT(errorLine(run("--methods general --seeds 1 --report-only")),
              HasSubstr("no finished run: folder out; expected runs of this command"));
  EXPECT_FALSE(fs::exists(folder.path("out")));
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

TEST_F(SlamCompareResume, ListedCommandsMakeTheSameRuns) {
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

TEST_F(SlamCompareResume, TwoProcessesInOneFolderAreAnError) {
  fs::create_directories(folder.path("out"));
  EXPECT_THAT(errorLine(shell("flock out/.lock " + call("--methods general --seeds 1 -q"))),
              HasSubstr("another slam-compare is running"));
}

/// One report is of one log: that of another would be lost, and its runs counted with these.
TEST_F(SlamCompareResume, AnotherLogNeedsAnotherFolder) {
  ASSERT_EQ(run(" --methods general --particles 4 --seeds 1 -q").status, 0);
  const std::string report = test::contentOf(folder.path("out/report.html"));
  fs::copy_file(kLog, folder.path("other.rawlog"));
  const Outcome outcome = shell(std::string("'") + SLAM_COMPARE + "' " + config +
                                " other.rawlog -o out --methods hybrid --particles 4 --seeds 1 -q");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("finished run of another comparison"));
  EXPECT_THAT(outcome.err, HasSubstr("other.rawlog"));
  EXPECT_EQ(test::contentOf(folder.path("out/report.html")), report);
  EXPECT_EQ(runs().size(), 1u);
}

/// The runs of a comparison differ in their seeds alone. A single particle does not close the loop.
TEST_F(SlamCompareResume, AContradictedRunIsNotRepeated) {
  config = folder.write("one.ini",
                        "[particle_filter]\nparticles = 0\nmin_particles = 1\nmax_particles = 1\n"
                        "proposal = standard\n");
  const std::string command = std::string("'") + SLAM_COMPARE + "' " + config + " " + kCsie +
                              "csie-loop.rawlog -o out -q --methods hybrid --seeds 1";
  ASSERT_EQ(shell(command).status, 0);
  const auto metrics =
      nlohmann::json::parse(test::contentOf(folder.path("out/runs/" + runs().at(0) + "/metrics.json")));
  EXPECT_EQ(metrics["verdict"], "doubtful");
  EXPECT_EQ(metrics["second_run"], false);
  const test::Outcome again = shell(command);
  EXPECT_EQ(again.status, 0) << again.err;
}

}  // namespace
}  // namespace hybrid_slam
