#include "slam/motion/MotionBelief.h"

#include <gtest/gtest.h>

#include "testing/SimulatedMotions.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;
using namespace test;

/// `options` with this standard deviation of the means.
MotionModelOptions unsure(MotionModelOptions options, double meanStd) {
  for (MotionTerm* term : {&options.distance, &options.drift, &options.turn}) term->meanStd = meanStd;
  return options;
}

MotionTerm MotionModelOptions::*const kTerms[] = {&MotionModelOptions::distance, &MotionModelOptions::drift,
                                                  &MotionModelOptions::turn};

double valueOf(MotionTerm MotionModelOptions::*term, const MotionSample& sample) {
  const MotionStep motion(sample.motion), odometry(sample.odometry);
  if (term == &MotionModelOptions::distance) return motion.distance;
  return term == &MotionModelOptions::drift ? motion.drift - odometry.drift : motion.turn;
}

TEST(MotionBelief, EqualsTheOptionsBeforeLearning) {
  const MotionModelOptions options = unsure(test::trueModel(), 0.07);
  const MotionModelOptions model = MotionBelief().model(options);
  for (const auto term : kTerms) {
    const MotionTerm &given = options.*term, &believed = model.*term;
    EXPECT_DOUBLE_EQ(believed.meanD, given.meanD);
    EXPECT_DOUBLE_EQ(believed.meanT, given.meanT);
    EXPECT_NEAR(believed.varianceD, given.varianceD + 0.07 * 0.07, 1e-12);
    EXPECT_NEAR(believed.varianceT, given.varianceT + 0.07 * 0.07, 1e-12);
    EXPECT_EQ(believed.covariance, 0);
  }
}

/// The posterior of a linear regression whose prior is one more set of data: rows sqrt(weight) (x, residual).
TEST(MotionBelief, IsTheBayesianRegressionOfTheMotions) {
  RandomStream random(1, 0, 0);
  for (const double meanStd : {0.003, 0.05, 0.5})
    for (const size_t steps : {1u, 3u, 40u}) {
      const MotionModelOptions options = unsure({}, meanStd);
      const auto samples = simulate(test::trueModel(), test::randomOdometry(steps, random), random);
      MotionBelief belief;
      for (const MotionSample& sample : samples) belief.learn(sample.odometry, sample.motion, options);
      const MotionModelOptions model = belief.model(options);
      for (const auto term : kTerms) {
        const MotionTerm &given = options.*term, &believed = model.*term;
        const double minStd = term == &MotionModelOptions::turn ? options.minStdPhi : options.minStdXY;
        Eigen::MatrixXd rows(steps + 2, 2);
        Eigen::VectorXd values(steps + 2);
        rows.topRows<2>() = Eigen::Matrix2d::Identity() / meanStd;
        values.head<2>() = Eigen::Vector2d(given.meanD, given.meanT) / meanStd;
        for (size_t i = 0; i < steps; ++i) {
          const MotionStep odometry(samples[i].odometry);
          const double deviation = std::sqrt(given.variance(odometry, minStd) + 1e-8);
          rows.row(static_cast<Eigen::Index>(i + 2)) =
              Eigen::RowVector2d(odometry.distance, odometry.turn) / deviation;
          values[static_cast<Eigen::Index>(i + 2)] = valueOf(term, samples[i]) / deviation;
        }
        const Eigen::Vector2d means = rows.colPivHouseholderQr().solve(values);
        const Eigen::Matrix2d covariance = (rows.transpose() * rows).inverse();
        EXPECT_NEAR(believed.meanD, means[0], 1e-9);
        EXPECT_NEAR(believed.meanT, means[1], 1e-9);
        EXPECT_NEAR(believed.varianceD - given.varianceD, covariance(0, 0), 1e-9);
        EXPECT_NEAR(believed.varianceT - given.varianceT, covariance(1, 1), 1e-9);
        EXPECT_NEAR(believed.covariance, covariance(0, 1), 1e-9);
        const MotionStep step(0.4, 0, -0.3);  // the variance of a prediction: v + x^T covariance x
        const Eigen::Vector2d x(step.distance, step.turn);
        EXPECT_NEAR(believed.variance(step, minStd), given.variance(step, minStd) + x.dot(covariance * x),
                    1e-9);
      }
    }
}

TEST(MotionBelief, FindsTheTrueMeansFromAnyStart) {
  RandomStream random(2, 0, 0);
  const MotionModelOptions truth = test::trueModel();
  const auto odometry = test::randomOdometry(3000, random);
  MotionModelOptions options = unsure(truth, 0.05);  // variances of `truth`, means of perfect odometry
  options.distance.meanD = 1, options.distance.meanT = options.drift.meanD = options.drift.meanT = 0;
  options.turn.meanD = 0, options.turn.meanT = 1;
  MotionBelief belief;
  for (const MotionSample& sample : simulate(truth, odometry, random))
    belief.learn(sample.odometry, sample.motion, options);
  const MotionModelOptions model = belief.model(options);
  for (const auto term : kTerms) {
    const double minStd = term == &MotionModelOptions::turn ? truth.minStdPhi : truth.minStdXY;
    const test::Parameters errors = test::standardErrors(truth.*term, minStd, odometry);
    EXPECT_NEAR((model.*term).meanD, (truth.*term).meanD, 5 * errors[0]);
    EXPECT_NEAR((model.*term).meanT, (truth.*term).meanT, 5 * errors[1]);
    EXPECT_NEAR((model.*term).varianceD, (truth.*term).varianceD, 2 * errors[0] * errors[0]);
  }
}

TEST(MotionBelief, LearnsNothingIfTheMeansAreKnown) {
  const MotionModelOptions options = test::trueModel();
  MotionBelief belief;
  belief.learn({0.5, 0, 0.1}, {0.1, 0.3, 0.4}, options);
  const MotionModelOptions model = belief.model(options);
  EXPECT_EQ(model.turn.meanD, options.turn.meanD);
  EXPECT_EQ(model.turn.varianceD, options.turn.varianceD);
}

/// A half turn may be returned with the other sign.
TEST(MotionBelief, TurnsAreTakenTheShorterWay) {
  const MotionModelOptions options;
  MotionBelief belief;
  belief.learn({0, 0, M_PI - 0.01}, {0, 0, -M_PI + 0.01}, options);  // 0.02 rad more than the odometry says
  const double mean = belief.model(options).turn.meanT;
  EXPECT_GT(mean, 1);
  EXPECT_LT(mean, 1.01);
}

TEST(MotionBelief, AModelWithoutNoiseStaysFinite) {
  MotionModelOptions options;
  for (MotionTerm* term : {&options.distance, &options.drift, &options.turn})
    term->varianceD = term->varianceT = 0;
  options.minStdXY = options.minStdPhi = 0;
  MotionBelief belief;
  for (int i = 0; i < 1000; ++i) belief.learn({0, 0, 0}, {0.001, 0, 0}, options);
  belief.learn({0.5, 0, 0}, {0.5, 0, 0}, options);
  const MotionModelOptions model = belief.model(options);
  EXPECT_NEAR(model.distance.meanD, 1, 1e-6);
  EXPECT_TRUE(std::isfinite(model.turn.variance(MotionStep(1, 0, 1), 0)));
}

TEST(MotionBelief, AStepOverAGapTeachesNothing) {
  const MotionModelOptions options = unsure({}, 0.05);
  MotionBelief belief;
  belief.learn({kLongestStep + 0.1, 0, 0.3}, {2, 0.5, 0.5}, options);
  EXPECT_EQ(belief.model(options).distance.meanD, options.distance.meanD);
  belief.learn({kLongestStep - 0.1, 0, 0.3}, {2, 0.5, 0.5}, options);
  EXPECT_NE(belief.model(options).distance.meanD, options.distance.meanD);
}

}  // namespace
}  // namespace hybrid_slam
