/// slam-eval revisits: a map that closes, one that does not, all kinds of invalid input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "SlamEvalProgram.h"
#include "files/Trajectory.h"
#include "testing/TestLogs.h"

namespace hybrid_slam {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Three laps of 9.7 m each, as a rawlog and as a trajectory whose third lap is shifted by `shift` in y.
struct Revisits : SlamEval {
  void writeLaps(size_t steps, double shift) const {
    const test::Log log = test::laps(steps);
    test::writeGzipped(folder.path("laps.rawlog"), log);
    files::Trajectory trajectory;
    for (size_t i = 0; i < steps; ++i) {
      files::StampedPose p{1000 + 0.2 * static_cast<double>(i), test::poseOnLap(i, 80)};
      if (i >= 160) p.pose.y += shift;
      trajectory.push_back(p);
    }
    std::ofstream text(folder.path("laps.tum"));
    files::saveTum(trajectory, text);
  }
  const std::string call = "revisits --trajectory laps.tum --rawlog laps.rawlog ";
};

TEST_F(Revisits, ClosedAndDoubled) {
  writeLaps(240, 0);
  const json closed = figures(call);
  EXPECT_EQ(closed.size(), 7u);
  EXPECT_EQ(closed.at("scans"), 240);
  EXPECT_GT(closed.at("revisits"), 60);
  EXPECT_EQ(closed.at("apart"), 0);
  EXPECT_LT(closed.at("max_m"), 1e-5);  // readings and stamps are rounded

  writeLaps(240, 0.3);
  const json doubled = figures(call);
  EXPECT_NEAR(doubled.at("max_m"), 0.3, 0.01);
  EXPECT_GT(doubled.at("p95_m"), 0.25);
  EXPECT_GE(doubled.at("mean_m"), 0.05);
  EXPECT_LE(doubled.at("median_m"), doubled.at("p95_m"));
}

TEST_F(Revisits, OptionsAreApplied) {
  writeLaps(240, 0.3);
  const int revisits = figures(call).at("revisits");
  EXPECT_EQ(figures(call + "--distance 3 --path 20").at("revisits"), revisits);
  EXPECT_LT(figures(call + "--distance 0.1").at("revisits"), revisits);
  EXPECT_GT(figures(call + "--path 10").at("revisits"), revisits);
  EXPECT_EQ(figures(call + "--max-range 0.5").at("revisits"), 0);  // no wall is this close
}

TEST_F(Revisits, TheLaserMayBeElsewhereThanTheLogSays) {
  writeLaps(240, 0);
  EXPECT_GT(figures(call + "--laser-pose '0.3, 0, 30'").at("max_m"), 0.1);
  EXPECT_LT(figures(call + "--laser-pose '0, 0, 0'").at("max_m"), 1e-5);
  EXPECT_THAT(errorLine(call + "--laser-pose here"), HasSubstr("key `laser_pose`"));
}

TEST_F(Revisits, ALaserThatIsIgnoredIsAWarning) {
  writeLaps(80, 0);
  test::Log log = test::laps(80);
  const auto tilted = test::scan(1016, {}, 181, "tilted");
  tilted->sensorPose = mrpt::poses::CPose3D(0, 0, 1, 0, 0.5, 0);
  log.push_back(tilted);
  test::writeGzipped(folder.path("laps.rawlog"), log);
  write("walls", "wall -5 -3 5 -3\n");
  for (const std::string& command :
       {call, std::string("plan --plan walls --truth walls --rawlog laps.rawlog --reference laps.tum")}) {
    const test::Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_THAT(outcome.err,
                HasSubstr("slam-eval: warning: laser `tilted` is not used: its scan plane is tilted\n"))
        << command;
  }
}

TEST_F(Revisits, NoRevisitsAreNotAFailure) {
  writeLaps(80, 0);
  const json j = figures(call);
  EXPECT_EQ(j.at("scans"), 80);
  EXPECT_EQ(j.at("revisits"), 0);
  EXPECT_EQ(j.at("apart"), 0);
  for (const char* figure : {"median_m", "mean_m", "p95_m", "max_m"})
    EXPECT_TRUE(j.at(figure).is_null()) << figure;
}

TEST_F(Revisits, WrongInput) {
  writeLaps(80, 0);
  write("other.tum", kStraight);
  EXPECT_EQ(errorLine("revisits --trajectory other.tum --rawlog laps.rawlog"),
            "slam-eval: error: no scan has a pose: trajectory 0.000..3.000 s, scans 1000.000..1015.800 s; "
            "expected poses within 0.001 s of the scans");
  EXPECT_THAT(errorLine("revisits --trajectory laps.tum --rawlog missing.rawlog"),
              HasSubstr("missing.rawlog"));
  EXPECT_THAT(errorLine("revisits --trajectory laps.tum --rawlog laps.tum"), HasSubstr("laps.tum"));
  EXPECT_THAT(errorLine("revisits --trajectory missing.tum --rawlog laps.rawlog"), HasSubstr("missing.tum"));
  test::writePlain(folder.path("whole.rawlog"), test::laps(80));
  ASSERT_EQ(shell("(head -c 50000 whole.rawlog >cut.rawlog)").status, 0);
  EXPECT_THAT(errorLine("revisits --trajectory laps.tum --rawlog cut.rawlog"),
              HasSubstr("of cut.rawlog; expected"));
  EXPECT_THAT(errorLine("revisits --trajectory laps.tum"), HasSubstr("--rawlog"));
  for (const char* option : {"--distance", "--path", "--max-range"})
    for (const char* value : {"0", "-1", "nan"})
      EXPECT_EQ(errorLine(call + option + "=" + value),
                std::string("slam-eval: error: wrong value: option ") + option +
                    "; expected a number of metres above 0");
}

}  // namespace
}  // namespace hybrid_slam
