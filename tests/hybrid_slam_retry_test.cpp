/// A run that is judged lost is repeated with more particles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "ChildProgram.h"
#include "HybridSlamProgram.h"
#include "files/Gzip.h"

namespace hybrid_slam {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kLog = SOURCE_DIR "/datasets/csie/csie-loop.rawlog";

class LostRun : public HybridSlam {
 protected:
  LostRun() { ini = SOURCE_DIR "/config-ini/csie-lms100.ini"; }
  /// A single particle does not close the loop.
  static std::string retrying(int particles, const std::string& number = "0") {
    return "-n " + number +
           " --set particle_filter.min_particles=1 --set particle_filter.max_particles=1 --set "
           "run.retry_particles=" +
           std::to_string(particles);
  }
  nlohmann::json metrics() const { return nlohmann::json::parse(result("metrics.json")); }
};

TEST_F(LostRun, IsRepeatedWithMoreParticles) {
  ASSERT_EQ(replay(kLog, retrying(20)), 0) << err;
  EXPECT_THAT(err, HasSubstr("verdict: lost: "));
  EXPECT_THAT(err, HasSubstr("\nsecond run, with 20 particles and seed 1; results so far: " + output + "\n"));
  EXPECT_THAT(out, HasSubstr("verdict: consistent"));
  EXPECT_EQ(metrics()["second_run"], true);
  EXPECT_EQ(metrics()["particles_min"], 20);
  EXPECT_THAT(results(), testing::UnorderedElementsAreArray(test::kResults));
  const std::string trajectory = result("trajectory.tum"), covariance = result("covariance.csv");
  ASSERT_EQ(replay(kLog, "-n 20"), 0) << err;
  EXPECT_EQ(result("trajectory.tum"), trajectory);
  EXPECT_EQ(result("covariance.csv"), covariance);
  EXPECT_EQ(metrics()["second_run"], false);
}

/// Three particles lose the loop; the third run, with one, is contradicted less.
TEST_F(LostRun, IsRepeatedTwice) {
  const std::string three =
      "-n 0 --set particle_filter.min_particles=3 --set particle_filter.max_particles=3 --set "
      "run.retry_particles=1";
  ASSERT_EQ(replay(kLog, three + " -s 3"), 0) << err;
  EXPECT_THAT(err, HasSubstr("\nsecond run, with 1 particle and seed 3; results so far: " + output + "\n"));
  EXPECT_THAT(err, HasSubstr("\nthird run, with 1 particle and seed 4; results so far: " + output + "\n"));
  EXPECT_EQ(metrics()["second_run"], true);
  EXPECT_EQ(metrics()["seed"], 4);
  const std::string trajectory = result("trajectory.tum");
  ASSERT_EQ(replay(kLog, "-n 1 -s 4"), 0) << err;
  EXPECT_EQ(result("trajectory.tum"), trajectory);
}

/// The map of two particles is doubtful, those of one are lost.
TEST_F(LostRun, IsKeptIfTheRepeatedRunsAreWorse) {
  const std::string two = "-n 0 --set particle_filter.min_particles=2 --set particle_filter.max_particles=2";
  ASSERT_EQ(replay(kLog, two + " --set run.retry_particles=0"), 0) << err;
  const std::string trajectory = result("trajectory.tum");
  EXPECT_EQ(metrics()["verdict"], "doubtful");
  ASSERT_EQ(replay(kLog, two + " --set run.retry_particles=1"), 0) << err;
  EXPECT_THAT(err, HasSubstr("warning: no results of a second run: its map is lost\n"));
  EXPECT_THAT(err, HasSubstr("warning: no results of a third run: its map is lost\n"));
  EXPECT_THAT(out, HasSubstr("verdict: doubtful"));
  EXPECT_EQ(result("trajectory.tum"), trajectory);
  EXPECT_EQ(metrics()["second_run"], false);
}

TEST_F(LostRun, IsKeptWithoutASecondRunOrWithAFixedNumber) {
  for (const std::string& options : {retrying(0), retrying(20, "1")}) {
    ASSERT_EQ(replay(kLog, options), 0) << err;
    EXPECT_THAT(err, Not(HasSubstr("second run")));
    EXPECT_EQ(metrics()["verdict"], "lost");
    EXPECT_EQ(metrics()["second_run"], false);
  }
}

TEST_F(LostRun, AStoppedOrKilledSecondRunLeavesTheResultsOfTheFirst) {
  ASSERT_EQ(replay(kLog, retrying(0)), 0) << err;
  const std::string trajectory = result("trajectory.tum");
  for (const int signal : {SIGINT, SIGKILL}) {
    std::vector<std::string> arguments{HYBRID_SLAM, "-n", "0", "--overwrite", "-o", output, ini, kLog};
    for (const char* setting :
         {"particle_filter.min_particles=1", "particle_filter.max_particles=1", "run.retry_particles=3000"}) {
      arguments.emplace_back("--set");
      arguments.emplace_back(setting);
    }
    test::ChildProgram program(folder, "run", arguments);
    EXPECT_TRUE(test::happens(
        [&] { return program.hasEnded() || program.err().find("second run") != std::string::npos; }));
    program.signal(signal);
    if (signal == SIGKILL) {
      EXPECT_EQ(program.endedBySignal(), SIGKILL);
    } else {
      EXPECT_EQ(program.wait(), 0);
      EXPECT_THAT(program.err(), HasSubstr("warning: no results of a second run: interrupted: entry "));
      EXPECT_THAT(program.err(), Not(HasSubstr("results cover")));
    }
    EXPECT_EQ(result("trajectory.tum"), trajectory);
    EXPECT_THAT(results(), testing::UnorderedElementsAreArray(test::kResults));
    EXPECT_EQ(metrics()["complete"], true);
    EXPECT_EQ(metrics()["verdict"], "lost");
  }
  ASSERT_EQ(replay(kLog, retrying(0)), 0) << err;
  for (const std::string& name : test::namesIn(folder.path("")))
    EXPECT_THAT(name, Not(HasSubstr(".part-"))) << "of the killed run";
}

TEST_F(LostRun, TheSecondRunReplacesTheSessionOfTheFirst) {
  ASSERT_EQ(replay(kLog, retrying(20) + " --checkpoint-every 0.05"), 0) << err;
  EXPECT_THAT(results(), testing::UnorderedElementsAreArray(test::kResults)) << "and no dated subfolder";
  EXPECT_EQ(metrics()["second_run"], true);
  ASSERT_EQ(run("--resume '" + output + "/session.hslam'"), 0) << err;
  EXPECT_EQ(metrics()["particles_min"], 20);
}

/// The run continues the map of an equally bad run.
TEST_F(LostRun, IsKeptWhereASecondRunCouldNotStartFromTheSameMap) {
  const std::string session = output + "/session.hslam", log = files::readGzip(kLog, "", 1 << 28);
  const std::string options = retrying(20) + " -s 2 --start 0,0,0 --continue '" + session + "'";
  ASSERT_EQ(replay(kLog, retrying(0) + " -s 2"), 0) << err;
  folder.write("begun.rawlog", log.substr(0, log.size() / 2));
  output = folder.path("begun");
  ASSERT_EQ(replay(folder.path("begun.rawlog"), options), 1) << err;

  output = folder.path("resumed");
  ASSERT_EQ(run("'" + kLog + "' --resume '" + folder.path("begun/session.hslam") + "' -o '" + output + "'"),
            0)
      << err;
  EXPECT_EQ(metrics()["verdict"], "lost");
  EXPECT_EQ(metrics()["second_run"], false);
  EXPECT_THAT(err, HasSubstr("warning: no second run: the session does not hold the map"));

  ASSERT_EQ(replay(kLog, options), 0) << err;
  EXPECT_THAT(err, HasSubstr("\nsecond run, with 20 particles")) << "the map is still there";
}

}  // namespace
}  // namespace hybrid_slam
