#include "slam/motion/MotionModelFit.h"

#include <gtest/gtest.h>

#include "testing/SimulatedMotions.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::math::TPose2D;

constexpr size_t kSteps = 5000;
constexpr double kErrors = 4;  // standard errors; 12 parameters in 5 runs leave 0.4 % for a false alarm

MotionModelOptions randomModel(RandomStream& random) {
  MotionModelOptions o;
  const auto spread = [&random] { return std::pow(10, -9 + 9 * random.uniform()); };
  for (MotionTerm* term : {&o.distance, &o.drift, &o.turn})
    *term = {random.gaussian(), random.gaussian(), random.uniform() < 0.2 ? 0 : spread(),
             random.uniform() < 0.2 ? 0 : spread()};
  o.minStdXY = 0.01 * random.uniform(), o.minStdPhi = 0.01 * random.uniform();
  return o;
}

TEST(MotionModelFit, RecoversTheParametersOfSimulatedOdometry) {
  for (const uint64_t seed : {1, 2, 3, 4, 5}) {
    RandomStream random(seed, 0, 0);
    const MotionModelOptions truth = test::trueModel(), prior;
    const auto odometry = test::randomOdometry(kSteps, random);
    const auto samples = simulate(truth, odometry, random);
    const MotionModelOptions fitted = fitMotionModel(samples, prior, determine(samples));
    const auto expectNear = [&](const MotionTerm& term, const MotionTerm& expected, double minStd) {
      const test::Parameters errors = test::standardErrors(expected, minStd, odometry);
      for (size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(test::parametersOf(term)[i], test::parametersOf(expected)[i], kErrors * errors[i]) << i;
    };
    expectNear(fitted.distance, truth.distance, truth.minStdXY);
    expectNear(fitted.drift, truth.drift, truth.minStdXY);
    expectNear(fitted.turn, truth.turn, truth.minStdPhi);
    EXPECT_GT(logLikelihood(samples, fitted), logLikelihood(samples, truth));
  }
}

TEST(MotionModelFit, RecoversTheVariancesFromStepsOverGaps) {
  RandomStream random(6, 0, 0);
  std::vector<TPose2D> odometry;
  for (size_t i = 0; i < kSteps; ++i)
    odometry.push_back(MotionStep(2 + 8 * random.uniform(), 0, 1.4 * (random.uniform() - 0.5)).increment());
  const MotionModelOptions truth = test::trueModel(), prior;
  const auto samples = simulate(truth, odometry, random);
  const MotionModelOptions fitted = fitMotionModel(samples, prior, determine(samples));
  EXPECT_NEAR(fitted.distance.varianceD, truth.distance.varianceD, 0.1 * truth.distance.varianceD);
  EXPECT_NEAR(fitted.turn.varianceD, truth.turn.varianceD, 0.1 * truth.turn.varianceD);
}

/// The first test is only meaningful if its bounds are narrow.
TEST(MotionModelFit, TheBoundsOfTheRecoveryAreNarrow) {
  RandomStream random(1, 0, 0);
  const test::Parameters errors =
      test::standardErrors(test::trueModel().distance, 0.005, test::randomOdometry(kSteps, random));
  EXPECT_LT(kErrors * errors[0], 0.015);   // m/m
  EXPECT_LT(kErrors * errors[1], 0.010);   // m/rad
  EXPECT_LT(kErrors * errors[2], 0.0006);  // of 0.004
  EXPECT_LT(kErrors * errors[3], 0.0002);  // of 0.0009
}

TEST(MotionModelFit, NeverLowersTheLikelihood) {
  RandomStream random(2, 0, 0);
  for (int run = 0; run < 20000; ++run) {
    const MotionModelOptions truth = randomModel(random), present = randomModel(random);
    auto samples = simulate(truth, test::randomOdometry(3 + random.bits() % 12, random), random);
    for (MotionSample& sample : samples) sample.weight = random.uniform();
    if (run % 3 == 0) samples[0].motion.x += 30;  // a slip
    Determination determined;
    determined.meanD = run % 5 != 0, determined.varianceD = run % 5 != 1;
    determined.meanT = run % 5 != 2, determined.varianceT = run % 5 != 3;
    const MotionModelOptions fitted = fitMotionModel(samples, present, determined);
    EXPECT_GE(logLikelihood(samples, fitted), logLikelihood(samples, present)) << run;
    for (const auto& [after, before] :
         {std::pair(fitted.distance, present.distance), std::pair(fitted.drift, present.drift),
          std::pair(fitted.turn, present.turn)}) {
      EXPECT_GE(after.varianceD, 0);
      EXPECT_GE(after.varianceT, 0);
      const test::Parameters is = test::parametersOf(after), was = test::parametersOf(before);
      const bool isFree[] = {determined.meanD, determined.meanT, determined.varianceD, determined.varianceT};
      for (size_t i = 0; i < 4; ++i) EXPECT_TRUE(isFree[i] || is[i] == was[i]) << run << " " << i;
    }
  }
}

/// Changing any parameter by a twentieth of a standard error, up or down, does not raise the likelihood.
TEST(MotionModelFit, FindsTheMaximumOfTheLikelihood) {
  RandomStream random(7, 0, 0);
  const auto odometry = test::randomOdometry(300, random);
  const auto samples = simulate(test::trueModel(), odometry, random);
  const MotionModelOptions fitted = fitMotionModel(samples, MotionModelOptions(), determine(samples));
  const double top = logLikelihood(samples, fitted);
  for (MotionTerm MotionModelOptions::*term :
       {&MotionModelOptions::distance, &MotionModelOptions::drift, &MotionModelOptions::turn}) {
    const test::Parameters errors = test::standardErrors(fitted.*term, fitted.minStdPhi, odometry);
    double MotionTerm::*const parameters[] = {&MotionTerm::meanD, &MotionTerm::meanT, &MotionTerm::varianceD,
                                              &MotionTerm::varianceT};
    for (size_t i = 0; i < 4; ++i)
      for (const double side : {-0.05, 0.05}) {
        MotionModelOptions neighbour = fitted;
        neighbour.*term.*parameters[i] += side * errors[i];
        EXPECT_LT(logLikelihood(samples, neighbour), top) << i;
      }
  }
}

TEST(MotionModelFit, TheLikelihoodIsThatOfTheSampledModel) {
  const MotionModelOptions model = test::trueModel();
  const TPose2D odometry(0.4, 0.03, 0.2);
  RandomStream random(4, 0, 0);
  double mean = 0;
  for (int i = 0; i < 10000; ++i)
    mean += logLikelihood({{odometry, sampleMotion(odometry, model, random), 1}}, model) / 10000;
  const MotionStep step(odometry);
  const double v = model.distance.variance(step, model.minStdXY) *
                   model.drift.variance(step, model.minStdXY) * model.turn.variance(step, model.minStdPhi);
  // The negative entropy of three normal numbers; each one's term has the standard deviation sqrt(1 / 2).
  EXPECT_NEAR(mean, -0.5 * std::log(v) - 1.5 * std::log(2 * M_PI * M_E), 4 * std::sqrt(1.5 / 10000));
}

TEST(MotionModelFit, HypothesesCountByTheirWeights) {
  const MotionModelOptions prior;
  std::vector<MotionSample> samples;
  for (int i = 0; i < 100; ++i) {
    const TPose2D odometry = MotionStep(0.3, 0, i % 2 ? 0.4 : -0.1).increment();
    samples.push_back({odometry, MotionStep(0.3 + 0.04, 0, odometry.phi).increment(), 0.25});
    samples.push_back({odometry, MotionStep(0.3, 0, odometry.phi).increment(), 0.75});
  }
  Determination determined;
  determined.varianceT = determined.meanT = false;
  MotionModelOptions noTurn = prior;
  noTurn.distance.varianceT = 0;
  const MotionModelOptions fitted = fitMotionModel(samples, noTurn, determined);
  EXPECT_NEAR(0.3 * fitted.distance.meanD, 0.31, 1e-6);
  const double variance = 0.25 * 0.75 * 0.04 * 0.04 - prior.minStdXY * prior.minStdXY;
  EXPECT_NEAR(0.09 * fitted.distance.varianceD, variance, 1e-6 * variance + 1e-11);
}

TEST(MotionModelFit, TurnsAreModuloAFullCircle) {
  std::vector<MotionSample> samples;
  for (int i = 0; i < 50; ++i) {
    const double turn = (i % 2 ? 1 : -1) * (M_PI - 0.02);
    TPose2D motion = MotionStep(0.3, 0.01, turn * 1.02).increment();  // beyond half a circle
    motion.phi = std::remainder(motion.phi, 2 * M_PI);
    samples.push_back({MotionStep(0.3, 0.01, turn).increment(), motion, 1});
  }
  const MotionModelOptions fitted = fitMotionModel(samples, MotionModelOptions(), determine(samples));
  EXPECT_NEAR(fitted.turn.meanT, 1.02, 1e-6);
  EXPECT_NEAR(fitted.distance.meanD, 1, 1e-6);
  EXPECT_NEAR(fitted.drift.meanD, 0, 1e-6);
}

TEST(MotionModelFit, ExactOdometryLeavesNoVariance) {
  MotionModelOptions prior;
  prior.minStdXY = prior.minStdPhi = 0;
  RandomStream random(5, 0, 0);
  std::vector<MotionSample> samples;
  for (const TPose2D& odometry : test::randomOdometry(200, random))
    samples.push_back({odometry, odometry, 1});
  const MotionModelOptions fitted = fitMotionModel(samples, prior, determine(samples));
  EXPECT_NEAR(fitted.distance.meanD, 1, 1e-6);
  EXPECT_NEAR(fitted.turn.meanT, 1, 1e-6);
  for (const MotionTerm* term : {&fitted.distance, &fitted.drift, &fitted.turn}) {
    EXPECT_NEAR(term->varianceD, 0, 1e-9);
    EXPECT_NEAR(term->varianceT, 0, 1e-9);
  }
}

}  // namespace
}  // namespace hybrid_slam
