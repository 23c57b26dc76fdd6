#include "slam/motion/MotionModelLearner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/ErrorOf.h"
#include "testing/SimulatedMotions.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::math::TPose2D;
using testing::HasSubstr;

/// Variances of the noise that hides the true motions: as large as the odometry noise of a short step.
constexpr double kNoiseXY = 1e-4, kNoisePhi = 1e-4;  // m^2, rad^2

/// A drive whose true D, C and T are observed with noise, so that its E-step has a closed form.
class HiddenMotions {
 public:
  HiddenMotions(const MotionModelOptions& truth, size_t steps, uint64_t seed) {
    RandomStream random(seed, 0, 0);
    odometry = test::randomOdometry(steps, random);
    for (const TPose2D& step : odometry) {
      const MotionStep motion(sampleMotion(step, truth, random));
      seen_.emplace_back(motion.distance + std::sqrt(kNoiseXY) * random.gaussian(),
                         motion.drift + std::sqrt(kNoiseXY) * random.gaussian(),
                         motion.turn + std::sqrt(kNoisePhi) * random.gaussian());
    }
  }

  /// Each posterior is normal. Two points, one standard deviation on either side of the mean, have the same
  /// mean and variance, and the M-step uses nothing else.
  Expectation expect(const MotionModelOptions& model) const {
    Expectation e;
    for (size_t i = 0; i < odometry.size(); ++i) {
      const MotionStep step(odometry[i]);
      const auto posterior = [&](const MotionTerm& term, double offset, double minStd, double seen,
                                 double noise) {
        const double mean = offset + term.mean(step), v = term.variance(step, minStd);
        e.logLikelihood -= (std::log(2 * M_PI * (v + noise)) + std::pow(seen - mean, 2) / (v + noise)) / 2;
        return std::pair(mean + v / (v + noise) * (seen - mean), std::sqrt(v * noise / (v + noise)));
      };
      const auto d = posterior(model.distance, 0, model.minStdXY, seen_[i].distance, kNoiseXY);
      const auto c = posterior(model.drift, step.drift, model.minStdXY, seen_[i].drift, kNoiseXY);
      const auto t = posterior(model.turn, 0, model.minStdPhi, seen_[i].turn, kNoisePhi);
      for (const double side : {-1, 1}) {
        const MotionStep point(d.first + side * d.second, c.first + side * c.second,
                               t.first + side * t.second);
        e.samples.push_back({odometry[i], point.increment(), 0.5});
      }
    }
    e.logLikelihood /= static_cast<double>(odometry.size());
    return e;
  }

  std::vector<TPose2D> odometry;

 private:
  std::vector<MotionStep> seen_;
};

struct Learning {
  LearntMotionModel learnt;
  std::vector<EmIteration> iterations;
};

Learning learn(const EStep& eStep, int maxIterations, const MotionModelOptions& prior = {}) {
  Learning run;
  run.learnt = learnMotionModel(prior, eStep, maxIterations, "log",
                                [&run](const EmIteration& done) { run.iterations.push_back(done); });
  return run;
}

TEST(MotionModelLearner, RecoversTheParametersOfHiddenMotionsAndTheLikelihoodRises) {
  for (const uint64_t seed : {1, 2, 3}) {
    const MotionModelOptions truth = test::trueModel();
    const HiddenMotions motions(truth, 4000, seed);
    const Learning run = learn([&](const auto& model) { return motions.expect(model); }, 100);
    EXPECT_TRUE(run.learnt.isConverged);
    EXPECT_GE(run.iterations.size(), 3u);  // a single M-step is not enough
    for (size_t i = 1; i < run.iterations.size(); ++i)
      EXPECT_GT(run.iterations[i].logLikelihood, run.iterations[i - 1].logLikelihood) << i;
    // Learning stops less than 1e-4 nats per step below the maximum: 0.4 in total, or one standard error.
    // Allow 5.
    const auto expectNear = [&](const MotionTerm& term, const MotionTerm& expected, double minStd,
                                double noise) {
      const test::Parameters errors = test::standardErrors(expected, minStd, motions.odometry, noise);
      for (size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(test::parametersOf(term)[i], test::parametersOf(expected)[i], 5 * errors[i])
            << seed << " " << i;
    };
    const MotionModelOptions& model = run.learnt.best.model;
    expectNear(model.distance, truth.distance, truth.minStdXY, kNoiseXY);
    expectNear(model.drift, truth.drift, truth.minStdXY, kNoiseXY);
    expectNear(model.turn, truth.turn, truth.minStdPhi, kNoisePhi);
  }
}

TEST(MotionModelLearner, KeepsTheBestIterationWhenTheLikelihoodFalls) {
  const HiddenMotions motions(test::trueModel(), 100, 1);
  // One decrease may be noise of the estimate; two in a row end the iteration.
  const std::vector<double> likelihoods{-5, -4, -4.5, -3, -3.5, -4, 0};
  size_t call = 0;
  const Learning run = learn(
      [&](const auto& model) {
        Expectation e = motions.expect(model);
        e.logLikelihood = likelihoods.at(call++);
        return e;
      },
      10);
  EXPECT_EQ(run.iterations.size(), 6u);
  EXPECT_TRUE(run.learnt.isConverged);
  EXPECT_EQ(run.learnt.best.number, 3);
  EXPECT_EQ(run.learnt.best.logLikelihood, -3);
  EXPECT_EQ(run.learnt.best.model.distance.meanD, run.iterations[3].model.distance.meanD);
}

TEST(MotionModelLearner, KeepsTheUncertaintyOfMeansThatWereNotLearnt) {
  MotionModelOptions prior;
  prior.distance.meanStd = 0.01, prior.drift.meanStd = 0.02, prior.turn.meanStd = 0.03;
  HiddenMotions motions(test::trueModel(), 200, 1);
  double likelihood = 0;
  const EStep expectFalling = [&](const MotionModelOptions& model) {
    EXPECT_EQ(model.turn.meanStd, 0) << "an iteration takes the means as known";
    Expectation e = motions.expect(model);
    e.logLikelihood = --likelihood;
    return e;
  };
  const MotionModelOptions kept = learn(expectFalling, 10, prior).learnt.best.model;
  EXPECT_EQ(test::parametersOf(kept.turn), test::parametersOf(prior.turn));
  EXPECT_EQ(kept.distance.meanStd, 0.01);
  EXPECT_EQ(kept.turn.meanStd, 0.03);

  const EStep expect = [&](const MotionModelOptions& model) { return motions.expect(model); };
  EXPECT_EQ(learn(expect, 10, prior).learnt.best.model.turn.meanStd, 0);
  for (TPose2D& step : motions.odometry) step = {step.x, 0, 0};
  EXPECT_EQ(learn(expect, 10, prior).learnt.best.model.turn.meanStd, 0.03) << "no turn to learn from";
}

TEST(MotionModelLearner, EndsAfterTheMaximumNumberOfIterations) {
  const HiddenMotions motions(test::trueModel(), 100, 1);
  double likelihood = 0;
  const Learning run = learn(
      [&](const auto& model) {
        Expectation e = motions.expect(model);
        e.logLikelihood = ++likelihood;
        return e;
      },
      4);
  EXPECT_EQ(run.iterations.size(), 5u);
  EXPECT_FALSE(run.learnt.isConverged);
  EXPECT_EQ(run.learnt.best.number, 4);
}

TEST(MotionModelLearner, UndeterminedParametersKeepThePrior) {
  HiddenMotions motions(test::trueModel(), 200, 1);
  for (TPose2D& step : motions.odometry) step = {step.x, 0, 0};
  MotionModelOptions prior;
  prior.turn.meanT = 0.9;
  const Learning run = learn([&](const auto& model) { return motions.expect(model); }, 10, prior);
  ASSERT_EQ(run.learnt.determined.lacks.size(), 1u);
  for (const EmIteration& iteration : run.iterations) EXPECT_EQ(iteration.model.turn.meanT, 0.9);
  EXPECT_NE(run.learnt.best.model.turn.meanD, prior.turn.meanD);
}

TEST(MotionModelLearner, AShortLogIsAnError) {
  const HiddenMotions motions(test::trueModel(), 5, 1);
  const std::string error =
      test::errorOf([&] { learn([&](const auto& model) { return motions.expect(model); }, 10); });
  EXPECT_THAT(error, HasSubstr("too short"));
  EXPECT_THAT(error, HasSubstr(": log; "));
  EXPECT_THAT(error, HasSubstr("at least 20 needed"));
}

}  // namespace
}  // namespace hybrid_slam
