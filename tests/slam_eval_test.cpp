/// slam-eval from the command line: figures, agreement with the reference evaluator, all kinds of invalid
/// input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <string>

#include "InstalledProgram.h"
#include "SlamEvalProgram.h"
#include "base/RandomStream.h"
#include "files/Trajectory.h"
#include "study/evaluation/RelationErrors.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using testing::HasSubstr;

const char* const kLonger =  // 10 % longer, turned by 90 deg, shifted by (5, 6)
    "0 5 6 0 0 0 0.7071067811865476 0.7071067811865476\n"
    "1 5 7.1 0 0 0 0.7071067811865476 0.7071067811865476\n"
    "2 5 8.2 0 0 0 0.7071067811865476 0.7071067811865476\n"
    "3 5 9.3 0 0 0 0.7071067811865476 0.7071067811865476\n";

TEST_F(SlamEval, HelpAndVersion) {
  for (const char* call : {"--help", "relations --help", "ate --help", "rpe --help", "revisits --help",
                           "nees-relations --help"}) {
    const Outcome o = run(call);
    EXPECT_EQ(o.status, 0) << call;
    EXPECT_THAT(o.out, HasSubstr("Usage: slam-eval")) << call;
  }
  const Outcome version = run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "slam-eval " HYBRID_SLAM_VERSION "\n");
}

TEST_F(SlamEval, RelationsThatAreNotUsedAreCounted) {
  write("estimate.tum", kStraight);
  write("truth.relations", "0 1 1 0 0 0 0 0\n0.5 2 1.5 0 0 0 0 0\n1.5 3 1.5 0 0 0 0 0\n");
  const std::string call = "relations --trajectory estimate.tum --relations truth.relations";
  const Outcome o = run(call);
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(json::parse(o.out).at("used"), 1);
  EXPECT_EQ(o.err,
            "slam-eval: warning: 2 of 3 relations not used: no pose within 0.006 s of their times in "
            "estimate.tum; --odometry carries poses to them\n");
  write("odometry.txt", "0 0 0 0\n0.5 0.5 0 0\n1 1 0 0\n1.5 1.5 0 0\n2 2 0 0\n3 3 0 0\n");
  EXPECT_EQ(figures(call + " --odometry odometry.txt").at("used"), 3);
}

TEST_F(SlamEval, AteByHand) {
  write("truth.tum", kStraight);
  write("estimate.tum", kLonger);
  // The poses lie 0.5 and 1.5 m from the centre, so they are off by 0.05 and 0.15 m.
  const json j = figures("ate --trajectory estimate.tum --reference truth.tum");
  EXPECT_EQ(j.at("poses"), 4);
  EXPECT_EQ(j.at("pairs"), 4);
  EXPECT_NEAR(j.at("trans_rmse_m"), std::sqrt(0.0125), 1e-9);
  EXPECT_NEAR(j.at("trans_mean_m"), 0.1, 1e-9);
  EXPECT_NEAR(j.at("trans_median_m"), 0.15, 1e-9);
  EXPECT_NEAR(j.at("trans_std_m"), 0.05, 1e-9);
  EXPECT_NEAR(j.at("trans_max_m"), 0.15, 1e-9);
  EXPECT_NEAR(j.at("alignment").at("phi_deg"), -90, 1e-9);
  EXPECT_NEAR(j.at("alignment").at("x_m"), 1.5 - 7.65, 1e-9);
  EXPECT_NEAR(j.at("alignment").at("y_m"), 5, 1e-9);
}

TEST_F(SlamEval, RpeByHandOverDistanceAndTime) {
  write("truth.tum", kStraight);
  write("estimate.tum", kLonger);
  for (const char* delta : {"2m", "2s"}) {
    const json j =
        figures(std::string("rpe --trajectory estimate.tum --reference truth.tum --delta ") + delta);
    EXPECT_EQ(j.at("delta"), delta);
    EXPECT_EQ(j.at("pairs"), 2);
    for (const char* figure : {"rmse", "mean", "median", "max"}) {
      EXPECT_NEAR(j.at(std::string("trans_") + figure + "_m"), 0.2, 1e-9) << figure;
      EXPECT_NEAR(j.at(std::string("rot_") + figure + "_deg"), 0, 1e-9) << figure;
    }
    EXPECT_NEAR(j.at("trans_std_m"), 0, 1e-9);
    EXPECT_NEAR(j.at("rot_std_deg"), 0, 1e-9);
  }
}

TEST_F(SlamEval, RelationsByHandWithAndWithoutOdometry) {
  write("estimate.tum", "0 0 0 0 0 0 0 1\n2 2 0.4 0 0 0 0 1\n");
  write("truth.relations", "0 2 2 0.4 0 0 0 0.017453292519943295\n0 1 1 0 0 0 0 0\n");
  write("odometry.txt", "0 0 0 0\n1 1 0 0\n2 2 0 0\n");
  const std::string call = "relations --trajectory estimate.tum --relations truth.relations";
  const json without = figures(call);
  EXPECT_EQ(without.size(), 8u);
  EXPECT_EQ(without.at("relations"), 2);
  EXPECT_EQ(without.at("used"), 1);
  EXPECT_NEAR(without.at("trans_mean_m"), 0, 1e-12);
  EXPECT_NEAR(without.at("rot_mean_deg"), 1, 1e-12);

  ASSERT_EQ(shell("gzip -k odometry.txt").status, 0);
  for (const char* odometry : {"odometry.txt", "odometry.txt.gz"}) {
    const json with = figures(call + " --odometry " + odometry);
    EXPECT_EQ(with.at("used"), 2);
    EXPECT_NEAR(with.at("trans_mean_m"), 0.1, 1e-12);
    EXPECT_NEAR(with.at("trans_std_m"), 0.1, 1e-12);
    EXPECT_NEAR(with.at("trans_median_m"), 0.2, 1e-12);
    EXPECT_NEAR(with.at("trans_max_m"), 0.2, 1e-12);
    EXPECT_NEAR(with.at("rot_mean_deg"), 0.5, 1e-12);
    EXPECT_NEAR(with.at("rot_std_deg"), 0.5, 1e-12);
  }
}

TEST_F(SlamEval, ToleranceDecidesWhichPosesArePaired) {
  write("truth.tum", kStraight);
  write("late.tum", "0.01 0 0 0 0 0 0 1\n1.01 1 0 0 0 0 0 1\n2.04 2 0 0 0 0 0 1\n");
  EXPECT_EQ(figures("ate --trajectory late.tum --reference truth.tum").at("pairs"), 2);
  EXPECT_EQ(figures("ate --trajectory late.tum --reference truth.tum --tolerance 0.05").at("pairs"), 3);
}

TEST_F(SlamEval, EveryFileMayBeAnInstalledOne) {
  const test::InstalledProgram installed(folder, SLAM_EVAL_PROGRAM);
  const auto install = [&](const std::string& name, const std::string& text) {
    std::ofstream(installed.data(name)) << text;
  };
  const auto call = [&](const std::string& arguments) {
    return test::shell(folder, "'" + installed.path + "' " + arguments);
  };
  install("path", kStraight);
  install("relations", "0 2 2 0 0 0 0 0\n");
  install("odometry", "0 0 0 0\n1 1 0 0\n2 2 0 0\n3 3 0 0\n");
  install("covariances",
          "timestamp,xx,xy,yy,xphi,yphi,phiphi\n0,1,0,1,0,0,1\n1,1,0,1,0,0,1\n"
          "2,1,0,1,0,0,1\n3,1,0,1,0,0,1\n");
  install("plan", "wall 0 0 4 0\n");
  install("text", "text");
  for (const char* arguments :
       {"relations --trajectory data/path --relations data/relations --odometry data/odometry",
        "nees --trajectory data/path --covariances data/covariances --reference data/path",
        "plan --plan data/plan --truth data/plan"}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments << ": " << outcome.err;
  }
  const std::string log = "revisits --trajectory data/path --rawlog data/";
  test::expectInputError(call(log + "text"), "slam-eval", installed.data("text"));
  test::expectInputError(call(log + "none"), "slam-eval", "no such file: data/none;");
}

TEST_F(SlamEval, WrongFiles) {
  write("truth.tum", kStraight);
  write("broken.tum", "# ok\n0 0 0 0 0 0 0 1\n1 0 0\n");
  write("empty.tum", "");
  write("later.tum", "100 0 0 0 0 0 0 1\n101 0 0 0 0 0 0 1\n");
  write("broken.relations", "0 1 1 0 0 0 0 0\n0 2 2 0 0 0 0\n");
  write("later.relations", "100 101 1 0 0 0 0 0\n");
  write("good.relations", "0 1 1 0 0 0 0 0\n");
  write("broken.odometry", "0 0 0 0\n1 1 0 zero\n");

  const std::string tum = "`timestamp x y z qx qy qz qw`";
  EXPECT_EQ(
      errorLine("ate --trajectory missing.tum --reference truth.tum"),
      "slam-eval: error: cannot open the file: file `missing.tum`; expected lines of 8 numbers, " + tum);
  EXPECT_EQ(errorLine("rpe --trajectory truth.tum --reference broken.tum"),
            "slam-eval: error: broken line: file `broken.tum`, line 3; expected lines of 8 numbers, " + tum);
  EXPECT_EQ(errorLine("ate --trajectory empty.tum --reference truth.tum"),
            "slam-eval: error: the file is empty: file `empty.tum`; expected lines of 8 numbers, " + tum);
  for (const char* command : {"ate", "rpe"})
    EXPECT_EQ(
        errorLine(std::string(command) + " --trajectory truth.tum --reference later.tum"),
        "slam-eval: error: the reference does not overlap the trajectory in time: trajectory 0.000..3.000 "
        "s, reference 100.000..101.000 s; expected poses within 0.02 s of each other");
  EXPECT_EQ(
      errorLine("relations --trajectory truth.tum --relations broken.relations"),
      "slam-eval: error: broken line: file `broken.relations`, line 2; expected lines of 8 numbers, `t1 t2 "
      "x y z roll pitch yaw`");
  EXPECT_THAT(errorLine("relations --trajectory truth.tum --relations later.relations"),
              HasSubstr("no usable relation: trajectory 0.000..3.000 s, relations 100.000..101.000 s; "));
  EXPECT_EQ(
      errorLine("relations --trajectory truth.tum --relations good.relations --odometry broken.odometry"),
      "slam-eval: error: broken line: file `broken.odometry`, line 2; expected lines of 4 numbers, `t x y "
      "theta`");
  EXPECT_THAT(errorLine("ate --trajectory . --reference truth.tum"), HasSubstr("cannot read the file"));
}

TEST_F(SlamEval, WrongCommandLines) {
  write("truth.tum", kStraight);
  for (const char* call : {"", "map", "ate", "ate --trajectory truth.tum", "relations --trajectory truth.tum",
                           "ate --trajectory truth.tum --reference truth.tum --delta 1m",
                           "ate --trajectory truth.tum --reference truth.tum --tolerance wide"})
    EXPECT_THAT(errorLine(call), HasSubstr(": command line; see slam-eval --help")) << call;
  const std::string pair = " --trajectory truth.tum --reference truth.tum ";
  for (const char* tolerance : {"-1", "nan"})
    EXPECT_THAT(errorLine("ate" + pair + "--tolerance=" + tolerance),
                HasSubstr("option --tolerance; expected"));
  for (const char* delta : {"1", "m", "1km", "0m", "-1s", "nans", "infm", "1 m"})
    EXPECT_EQ(errorLine("rpe" + pair + "--delta='" + delta + "'"),
              std::string("slam-eval: error: wrong value `") + delta +
                  "`: option --delta; expected a positive number with its unit, as in `1s` or `0.5m`");
  EXPECT_THAT(errorLine("rpe" + pair + "--delta 50m"), HasSubstr("no pose pairs 50 m apart"));
}

TEST_F(SlamEval, AFailedWriteIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  write("truth.tum", kStraight);
  const Outcome o = shell(std::string("('") + SLAM_EVAL_PROGRAM +
                          "' ate --trajectory truth.tum --reference truth.tum >/dev/full)");
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(o.err,
            "slam-eval: error: cannot write: standard output; expected free disk space or an open pipe\n");
}

/// The Intel log's odometry as a trajectory: inaccurate, but with all difficulties for the metric.
struct ReferenceEvaluator : SlamEval {
  fs::path datasets, evaluator;
  files::Trajectory odometry;

  void SetUp() override {
    const char* const name = std::getenv("HYBRID_SLAM_DATASETS");
    if (!name) GTEST_SKIP() << "HYBRID_SLAM_DATASETS is not set";
    datasets = fs::absolute(name);
    evaluator = datasets / ".." / "tools";
    if (!fs::exists(evaluator / "evalrel.py")) GTEST_SKIP() << "no evalrel.py in " << evaluator;
    if (shell("python3 --version").status != 0) GTEST_SKIP() << "no python3";
    odometry = files::loadOdometry((datasets / "intel-lab.odom.gz").string());
    std::ofstream text(folder.path("odometry.txt"));  // it reads plain text only
    text << std::setprecision(17);
    for (const files::StampedPose& o : odometry)
      text << o.timestamp << ' ' << o.pose.x << ' ' << o.pose.y << ' ' << o.pose.phi << '\n';
  }

  /// Every `step`-th reading with noise, in log order, with the stamps as a TUM file holds them.
  files::Trajectory noisyTrajectory(size_t step) const {
    RandomStream random(9, step, 0);
    files::Trajectory t;
    for (size_t i = 0; i < odometry.size(); i += step) {
      files::StampedPose p = odometry[i];
      p.pose.x += 0.05 * random.gaussian();
      p.pose.y += 0.05 * random.gaussian();
      p.pose.phi += 0.02 * random.gaussian();
      t.push_back(p);
    }
    return t;
  }

  json expected(const files::Trajectory& trajectory, bool bridge, double tolerance) const {
    {
      std::ofstream text(folder.path("trajectory.txt"));
      text << std::setprecision(17);
      for (const files::StampedPose& p : trajectory)
        text << p.timestamp << ' ' << p.pose.x << ' ' << p.pose.y << ' ' << p.pose.phi << '\n';
    }
    write("run.py",
          "import sys, json\n"
          "sys.path.insert(0, sys.argv[1])\n"
          "import evalrel as e\n"
          "odometry = e.load('odometry.txt') if sys.argv[3] == '1' else None\n"
          "print(json.dumps(e.evaluate(e.load('trajectory.txt'), e.loadrel(sys.argv[2]), odometry, "
          "float(sys.argv[4]))))\n");
    const Outcome o = shell("python3 -B run.py '" + evaluator.string() + "' '" + relationsFile() + "' " +
                            (bridge ? "1 " : "0 ") + std::to_string(tolerance));
    EXPECT_EQ(o.status, 0) << o.err;
    return o.status == 0 ? json::parse(o.out) : json();
  }

  std::string relationsFile() const { return (datasets / "intel-lab.relations").string(); }

  void compare(size_t step, bool bridge, double tolerance) const {
    SCOPED_TRACE(testing::Message() << "every " << step << "th reading, bridge " << bridge);
    const files::Trajectory trajectory = noisyTrajectory(step);
    const json theirs = expected(trajectory, bridge, tolerance);
    ASSERT_TRUE(theirs.is_object());
    {
      std::ofstream text(folder.path("trajectory.tum"));
      files::saveTum(trajectory, text);
    }
    const json ours =
        figures("relations --trajectory trajectory.tum --relations '" + relationsFile() + "' --tolerance " +
                std::to_string(tolerance) +
                (bridge ? " --odometry '" + (datasets / "intel-lab.odom.gz").string() + "'" : ""));
    EXPECT_EQ(ours.at("relations"), theirs.at("relations"));
    EXPECT_EQ(ours.at("used"), theirs.at("usable"));
    EXPECT_GT(ours.at("used"), 100);
    const std::pair<const char*, const char*> names[] = {
        {"trans_mean_m", "trans_abs"}, {"trans_std_m", "trans_abs_std"}, {"trans_median_m", "trans_median"},
        {"trans_max_m", "trans_max"},  {"rot_mean_deg", "rot_abs_deg"},  {"rot_std_deg", "rot_abs_std"}};
    for (const auto& [ourName, theirName] : names)
      EXPECT_NEAR(ours.at(ourName), theirs.at(theirName), 1e-6) << ourName;

    // A direct call rounds nothing, so the agreement is closer and includes all figures.
    const evaluation::RelationErrors e = evaluation::evaluateRelations(
        trajectory, evaluation::loadRelations(relationsFile()), bridge ? &odometry : nullptr, tolerance);
    EXPECT_EQ(e.used, theirs.at("usable"));
    EXPECT_NEAR(e.translation.rmse * e.translation.rmse, theirs.at("trans_sq"), 1e-9);
    EXPECT_NEAR(e.translation.mean, theirs.at("trans_abs"), 1e-9);
    EXPECT_NEAR(e.translation.median, theirs.at("trans_median"), 1e-9);
    EXPECT_NEAR(e.rotation.max * 180 / M_PI, theirs.at("rot_max"), 1e-9);
  }
};

TEST_F(ReferenceEvaluator, AgreesWithTheOdometryBridge) {
  for (const size_t step : {3, 10, 30, 100}) compare(step, true, 0.006);
  compare(30, true, 0.05);  // both hold it at 0.006 s
  compare(30, true, 0.002);
}

TEST_F(ReferenceEvaluator, AgreesWithoutTheOdometryBridge) {
  compare(1, false, 0.006);
  compare(3, false, 0.05);
  compare(10, false, 0.5);
}

}  // namespace
}  // namespace hybrid_slam
