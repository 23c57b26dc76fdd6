/// Exit code, messages and learnt section of the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <array>
#include <filesystem>
#include <regex>
#include <sstream>

#include "ChildProgram.h"
#include "Shell.h"
#include "files/Trajectory.h"
#include "run/Configuration.h"
#include "slam/motion/MotionModelFit.h"
#include "study/simulation/WheelOdometry.h"
#include "testing/SimulatedMotions.h"
#include "testing/TestLogs.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

const std::string kDoorways = SOURCE_DIR "/datasets/csie/csie-doorways.rawlog";
/// A straight drive of 44 s with one half turn.
const std::string kCorridor = SOURCE_DIR "/datasets/csie/csie-corridor.rawlog";

class MotionModelLearn : public test::ProgramTest {
 protected:
  MotionModelLearn() : ProgramTest(MOTION_MODEL_LEARN) {}
  int run(const std::string& arguments) {
    const int status = ProgramTest::run(arguments);
    err = test::withoutProgress(err);
    return status;
  }
  std::string arguments(const std::string& log, const std::string& options = "") const {
    return "'" + ini + "' '" + log + "' -o '" + output + "' " + options;
  }
  int learn(const std::string& log, const std::string& options = "") { return run(arguments(log, options)); }
  std::string logOf(size_t steps) { return test::writeGzipped(folder.path("log.rawlog"), test::laps(steps)); }
  /// Expects exit code 2, one error line and no file.
  void expectError(int exitCode, const std::string& text) {
    test::expectInputError({exitCode, out, err}, "motion-model-learn", text);
    EXPECT_FALSE(fs::exists(output));
    EXPECT_FALSE(fs::exists(folder.path(".partial.motion.ini")));
  }
  /// Returns the learnt model as hybrid-slam reads it from `cat config.ini motion.ini`.
  MotionModelOptions learnt() const {
    const std::string both = folder.write("both.ini", test::contentOf(ini) + test::contentOf(output));
    return run::Configuration(both, {}).filter.motion;
  }
  /// The numbers of the table of iterations, a list for each row.
  std::vector<std::vector<double>> rows() const {
    std::vector<std::vector<double>> all;
    std::istringstream lines(std::regex_replace(out, std::regex("\\|"), " "));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream numbers(line);
      std::vector<double> row;
      for (double number = 0; numbers >> number;) row.push_back(number);
      if (!row.empty()) all.push_back(row);
    }
    return all;
  }

  std::string ini = folder.write("run.ini",
                                 "[particle_filter]\nparticles = 3\nproposal = improved\n"
                                 "[improved_proposal]\nupdate_distance = 0.3\nupdate_angle_deg = 15\n"
                                 "[grid]\nresolution = 0.05\nmax_range = 20\n"
                                 "[motion_model]\ndistance_mean_d = 0.95\nturn_mean_t = 1.05\n");
  std::string output = folder.path("motion.ini");
};

/// Returns the motions between the true poses, from which EM's M-step would learn without hidden variables.
std::vector<MotionSample> trueMotions(const std::string& log, const std::string& truth) {
  constexpr double kUpdateDistance = 0.3, kUpdateAngle = mrpt::DEG2RAD(15.0);  // as in the INI file
  const files::Trajectory poses = files::loadTum(truth);
  readings::RawlogSource source(log, readings::InputOptions(), summarise(log, readings::InputOptions()));
  std::vector<MotionSample> samples;
  mrpt::math::TPose2D odometry, last = poses.front().pose;
  for (size_t i = 0; const auto reading = source.next(); ++i) {
    odometry = odometry + reading->motion;
    if (odometry.norm() < kUpdateDistance && std::abs(odometry.phi) < kUpdateAngle) continue;
    samples.push_back({odometry, poses.at(i).pose - last, 1});
    last = poses[i].pose;
    odometry = {};
  }
  return samples;
}

std::vector<mrpt::math::TPose2D> odometryOf(const std::vector<MotionSample>& motions) {
  std::vector<mrpt::math::TPose2D> all;
  for (const MotionSample& motion : motions) all.push_back(motion.odometry);
  return all;
}

/// Prints a table of doc/motion-model.md: the fit of the loop's true poses, the simulator's parameters for
/// such steps, and how well the steps determine them.
TEST(TrueMotions, OfTheLoopFitTheSimulatorsParameters) {
  const std::string loop = SOURCE_DIR "/datasets/csie/csie-loop";
  const auto motions = trueMotions(loop + ".rawlog", loop + ".tum");
  const MotionModelOptions prior, fit = fitMotionModel(motions, prior, determine(motions));
  // Lengths of a step: a variance s^2 |d| is s^2 / length d^2 in the sum over the steps.
  double way = 0, squaredWay = 0, turns = 0, squaredTurns = 0;
  for (const MotionSample& motion : motions) {
    const MotionStep step(motion.odometry);
    way += std::abs(step.distance), squaredWay += step.distance * step.distance;
    turns += std::abs(step.turn), squaredTurns += step.turn * step.turn;
  }
  const double length = squaredWay / way, turn = squaredTurns / turns;
  // The inverse of the simulated wheel errors; their variances grow with the distance, the model's with its
  // square.
  const simulation::OdometryOptions wheels;
  const auto variance = [](double sigma, double step, double minStd) {
    return sigma * sigma / step - minStd * minStd / (step * step);
  };
  MotionModelOptions simulated;
  simulated.distance = {1 / wheels.meanDd, 0, variance(wheels.sigmaDd, length, prior.minStdXY), 0};
  simulated.turn = {-wheels.meanTd / wheels.meanDd / wheels.meanTt, 1 / wheels.meanTt,
                    variance(wheels.sigmaTd, length, prior.minStdPhi),
                    variance(wheels.sigmaTt, turn, prior.minStdPhi)};

  const auto odometry = odometryOf(motions);
  const test::Parameters distanceErrors = test::standardErrors(simulated.distance, prior.minStdXY, odometry),
                         turnErrors = test::standardErrors(simulated.turn, prior.minStdPhi, odometry);
  std::printf(
      "%zu steps of %.2f m or %.0f deg\n| | distance mean_d | var_d | turn mean_d | mean_t | var_d | var_t "
      "|\n",
      motions.size(), length, turn * 180 / M_PI);
  std::printf("|---|---|---|---|---|---|---|\n");
  const auto row = [](const char* name, const test::Parameters& d, const test::Parameters& t) {
    std::printf("| %s | %.4f | %.1e | %.4f | %.3f | %.1e | %.1e |\n", name, d[0], d[2], t[0], t[1], t[2],
                t[3]);
  };
  row("true poses", test::parametersOf(fit.distance), test::parametersOf(fit.turn));
  row("simulator", test::parametersOf(simulated.distance), test::parametersOf(simulated.turn));
  row("standard error", distanceErrors, turnErrors);
  for (const size_t i : {0, 2})
    EXPECT_NEAR(test::parametersOf(fit.distance)[i], test::parametersOf(simulated.distance)[i],
                3 * distanceErrors[i]);
  for (size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(test::parametersOf(fit.turn)[i], test::parametersOf(simulated.turn)[i], 3 * turnErrors[i]);
}

TEST_F(MotionModelLearn, LearnsTheParametersOfTheTruePoses) {
  const auto motions = trueMotions(kDoorways, SOURCE_DIR "/datasets/csie/csie-doorways.tum");
  const MotionModelOptions prior;
  const MotionModelOptions expected = fitMotionModel(motions, prior, determine(motions));
  const auto odometry = odometryOf(motions);
  // 8 standard errors off at the start.
  EXPECT_GT(expected.distance.meanD - 0.95, 8 * test::standardErrors(expected.distance, 0.005, odometry)[0]);
  std::array<double, 12> mean{};  // of the columns of the table, without the likelihood
  for (const char* seed : {"1", "2", "3"}) {
    SCOPED_TRACE(seed);
    ASSERT_EQ(learn(kDoorways, std::string("-n 10 --iterations 3 --seed ") + seed), 0) << err;
    EXPECT_THAT(err, IsEmpty());
    const auto table = rows();
    ASSERT_EQ(table.size(), 4u) << out;
    size_t best = 0;
    for (size_t i = 0; i < table.size(); ++i) {
      ASSERT_EQ(table[i].size(), 14u);
      EXPECT_EQ(table[i][0], static_cast<double>(i));
      if (table[i][1] > table[best][1]) best = i;
    }
    EXPECT_EQ(table[0][2], 0.95);
    EXPECT_GT(table[1][1], table[0][1]);
    EXPECT_NEAR(table[best][2], learnt().distance.meanD, 1e-4) << "the file holds the best iteration";
    EXPECT_THAT(out, HasSubstr("iteration " + std::to_string(best) + " written to " + output + "\n"));
    for (size_t column = 0; column < mean.size(); ++column)
      for (const size_t iteration : {2, 3}) mean[column] += table[iteration][2 + column] / 6;
  }
  // The poses are hidden but well determined by the scans: from the second iteration on, on average over
  // particles' chance, the additional error is below the log's own uncertainty.
  const auto expectNear = [&](size_t first, const MotionTerm& truth, double minStd) {
    const test::Parameters errors = test::standardErrors(truth, minStd, odometry);
    for (size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(mean[first + i], test::parametersOf(truth)[i], errors[i]) << first << " " << i;
  };
  expectNear(0, expected.distance, prior.minStdXY);
  expectNear(4, expected.drift, prior.minStdXY);
  expectNear(8, expected.turn, prior.minStdPhi);
}

TEST_F(MotionModelLearn, ReportsUndeterminedParametersAndKeepsTheirPrior) {
  ASSERT_EQ(learn(kCorridor, "--iterations 1"), 0) << err;
  const std::string keys = "mean_t, var_t of distance, drift and turn",
                    why = "the robot turned 2.9 deg or more";
  EXPECT_THAT(err, MatchesRegex("motion-model-learn: warning: prior kept for " + keys + ": [^\n]*; " + why +
                                " in [0-9]+ updates; at least 20 needed\n"));
  EXPECT_THAT(test::contentOf(output),
              HasSubstr("# Not learnt but kept from " + ini + ": " + keys + ": " + why));
  EXPECT_EQ(learnt().turn.meanT, 1.05);
  EXPECT_EQ(learnt().distance.varianceT, MotionModelOptions().distance.varianceT);
  EXPECT_NE(learnt().distance.meanD, 0.95);
}

TEST_F(MotionModelLearn, SameSeedSameBytesForAnyNumberOfThreads) {
  const std::string log = logOf(100),
                    options = "-n 5 --iterations 1 --set improved_proposal.update_angle_deg=5";
  ASSERT_EQ(learn(log, options + " -s 3 -j 1 -q"), 0) << err;
  EXPECT_THAT(out, IsEmpty());
  EXPECT_THAT(err, IsEmpty());
  const std::string first = test::contentOf(output);
  EXPECT_THAT(first, HasSubstr(log));
  EXPECT_THAT(first, HasSubstr("\n# For updates every 0.3 m or 5 deg"));
  ASSERT_EQ(learn(log, options + " -s 3 -j 2 -q"), 0) << err;
  EXPECT_EQ(test::contentOf(output), first);
  ASSERT_EQ(learn(log, options + " -s 4 -q"), 0) << err;
  EXPECT_NE(test::contentOf(output), first);
}

TEST_F(MotionModelLearn, AnIgnoredLaserIsAWarning) {
  test::Log log = test::laps(100);
  const auto tilted = test::scan(1000, {}, 181, "TILTED");
  tilted->sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0.5, 0);
  log.push_back(tilted);
  const std::string path = test::writeGzipped(folder.path("log.rawlog"), log);
  EXPECT_EQ(learn(path, "--iterations 1 --set improved_proposal.update_angle_deg=5"), 0) << err;
  EXPECT_THAT(err, HasSubstr("motion-model-learn: warning: laser `TILTED` is not used: "));
  EXPECT_THAT(out, HasSubstr("laser LASER: 181 beams"));
}

TEST_F(MotionModelLearn, LearnsFromTheFirstPartOfATruncatedLog) {
  std::vector<size_t> ends;
  const std::string log = test::writePlain(folder.path("log.rawlog"), test::laps(100), &ends);
  fs::resize_file(log, ends.at(160) + 7);
  EXPECT_EQ(learn(log, "--iterations 1 --set improved_proposal.update_angle_deg=5"), 1);
  EXPECT_THAT(err, MatchesRegex("motion-model-learn: error: log cut off[^\n]*: entry 162 of [^\n]*; learnt "
                                "from the log up to this point\n"));
  EXPECT_TRUE(fs::exists(output));
}

TEST_F(MotionModelLearn, WrongInput) {
  expectError(learn(logOf(10)),
              "log too short or too uniform to learn from: " + folder.path("log.rawlog") + "; ");
  expectError(learn(folder.path("none")), "no such file");
  expectError(learn(folder.write("text", "once upon a time")), "text");
  expectError(
      learn(logOf(10), "--set motion_model.turn_var_t=-0.01"),
      "wrong value `-0.01`: command line, section [motion_model], key `turn_var_t`; expected a number in "
      "0..100");
  expectError(learn(logOf(10), "--set particle_filter.proposal=auxiliary_standard"),
              "expected standard or improved");
  expectError(learn(logOf(10), "--set run.method=stock"), "expected hybrid or general");
  ini = folder.write("negative.ini", "[motion_model]\ndrift_var_d = -1\n");
  expectError(learn(logOf(10)), "wrong value `-1`: " + ini + ", section [motion_model], key `drift_var_d`");
  ini = folder.path("none.ini");
  expectError(learn(logOf(10)), "no such file: " + ini);
}

TEST_F(MotionModelLearn, WrongCommandLine) {
  const std::string log = logOf(10);
  expectError(run("-o x.ini"), "no log");
  expectError(run("'" + ini + "' -o x.ini"), "no log");
  expectError(run("'" + ini + "' '" + log + "'"), "--output is required");
  expectError(learn(log, "--iterations 0"), "--iterations");
  expectError(learn(log, "-n -1"), "key `particles`");
  expectError(learn(log, "-s -1"), "key `seed`");
  expectError(learn(log, "--learn"), "--learn");
}

TEST_F(MotionModelLearn, TheOutputMustBeAnotherFileThatCanBeWritten) {
  const std::string log = logOf(100), before = test::contentOf(log), settings = test::contentOf(ini);
  EXPECT_EQ(run("'" + ini + "' '" + log + "' -o '" + log + "'"), 2);
  EXPECT_THAT(err, HasSubstr("the output is the input: " + log));
  EXPECT_EQ(run("'" + ini + "' '" + log + "' -o '" + ini + "'"), 2);
  EXPECT_THAT(err, HasSubstr("the output is the input: " + ini));
  EXPECT_EQ(test::contentOf(log), before);
  EXPECT_EQ(test::contentOf(ini), settings);
  output = folder.path("none/motion.ini");
  expectError(learn(log), "cannot write: " + output);
}

TEST_F(MotionModelLearn, ReplacesWhatItHasLearntOnly) {
  const std::string log = logOf(40);
  for (const std::string text :
       {"[motion_model]\n", "# Learnt by motion-model-learn\n[motion_model]\n\n[grid]\n"}) {
    folder.write("motion.ini", text);
    EXPECT_EQ(learn(log), 2);
    EXPECT_THAT(err, HasSubstr("the output exists and is no learnt motion model: " + output));
    EXPECT_EQ(test::contentOf(output), text);
  }
}

TEST_F(MotionModelLearn, CtrlCLeavesNoPartialFile) {
  const std::string log = logOf(4000);
  folder.write("motion.ini", "# Learnt by motion-model-learn before");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    test::ChildProgram program(folder, "run",
                               {MOTION_MODEL_LEARN, ini, log, "-o", output, "-q", "-n", "300"});
    EXPECT_TRUE(
        test::happens([&] { return program.hasEnded() || fs::exists(folder.path(".partial.motion.ini")); }));
    program.signal(signal);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(test::withoutProgress(program.err()),
                MatchesRegex("motion-model-learn: error: interrupted: entry [0-9]+ of [^\n]*; nothing was "
                             "written\n"));
    EXPECT_THAT(test::contentOf(output), testing::EndsWith("before"));
    EXPECT_FALSE(fs::exists(folder.path(".partial.motion.ini")));
  }
}

TEST_F(MotionModelLearn, HelpAndVersion) {
  EXPECT_EQ(run("--help"), 0);
  for (const char* option :
       {"--output", "--iterations", "--particles", "--seed", "--threads", "--set", "--quiet"})
    EXPECT_THAT(out, HasSubstr(option));
  EXPECT_EQ(run("--version"), 0);
  EXPECT_THAT(out, MatchesRegex("motion-model-learn [0-9]+[.][0-9]+[.][0-9]+\n"));
}

}  // namespace
}  // namespace hybrid_slam
