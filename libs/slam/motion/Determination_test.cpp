#include "slam/motion/Determination.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/motion/MotionModelFit.h"
#include "testing/SimulatedMotions.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::math::TPose2D;
using testing::HasSubstr;

/// Steps that are always the same function of the number i.
template <class Step>
std::vector<MotionSample> drive(size_t steps, const Step& step) {
  RandomStream random(3, 0, 0);
  std::vector<TPose2D> odometry;
  for (size_t i = 0; i < steps; ++i) odometry.push_back(step(i).increment());
  return simulate(test::trueModel(), odometry, random);
}

void expectKept(const MotionTerm& fitted, const MotionTerm& prior, bool keepsD, bool keepsT) {
  EXPECT_EQ(fitted.meanD == prior.meanD, keepsD);
  EXPECT_EQ(fitted.varianceD == prior.varianceD, keepsD);
  EXPECT_EQ(fitted.meanT == prior.meanT, keepsT);
  EXPECT_EQ(fitted.varianceT == prior.varianceT, keepsT);
}

TEST(Determination, ARobotThatNeverTurnedKeepsThePriorForTurns) {
  RandomStream noise(6, 0, 0);
  const auto samples = drive(1000, [&](size_t) { return MotionStep(0.3, 0, 0.003 * noise.gaussian()); });
  const Determination determined = determine(samples);
  ASSERT_EQ(determined.lacks.size(), 1u);
  EXPECT_EQ(determined.lacks[0].keys, "mean_t, var_t");
  EXPECT_EQ(determined.lacks[0].why, "the robot turned 2.9 deg or more in 0 updates; at least 20 needed");
  const MotionModelOptions prior, fitted = fitMotionModel(samples, prior, determined);
  expectKept(fitted.distance, prior.distance, false, true);
  expectKept(fitted.drift, prior.drift, false, true);
  expectKept(fitted.turn, prior.turn, false, true);
}

TEST(Determination, ARobotThatNeverMovedKeepsThePriorForMoves) {
  const auto samples =
      drive(100, [](size_t i) { return MotionStep(0.001, 0, 0.1 + 0.001 * static_cast<double>(i)); });
  const Determination determined = determine(samples);
  ASSERT_EQ(determined.lacks.size(), 1u);
  EXPECT_EQ(determined.lacks[0].keys, "mean_d, var_d");
  EXPECT_THAT(determined.lacks[0].why, HasSubstr("moved 2 cm or more in 0 updates"));
  const MotionModelOptions prior, fitted = fitMotionModel(samples, prior, determined);
  expectKept(fitted.distance, prior.distance, true, false);
  expectKept(fitted.turn, prior.turn, true, false);
}

TEST(Determination, TwentyStepsAreEnoughAndNineteenAreNot) {
  const auto step = [](size_t i) { return MotionStep(0.3, 0, i % 2 ? 0.3 : 0.1); };
  EXPECT_TRUE(determine(drive(20, step)).lacks.empty());
  EXPECT_TRUE(determine(drive(19, step)).nothing());
  EXPECT_TRUE(determine({}).nothing());
}

TEST(Determination, CirclesDetermineOnlyTheSum) {
  const auto circle = [](size_t i) {
    const double d = 0.1 + 0.01 * static_cast<double>(i % 30);
    return MotionStep(d, 0, 0.8 * d);
  };
  const Determination determined = determine(drive(200, circle));
  EXPECT_TRUE(determined.nothing());
  ASSERT_EQ(determined.lacks.size(), 2u);
  EXPECT_THAT(determined.lacks[0].why, HasSubstr("proportional"));
}

TEST(Determination, CirclesInBothDirectionsDetermineTheMeansButNotTheVariances) {
  const auto eight = [](size_t i) {
    const double d = 0.1 + 0.01 * static_cast<double>(i % 30);
    return MotionStep(d, 0, i % 2 ? 0.8 * d : -0.8 * d);
  };
  const auto samples = drive(200, eight);
  const Determination determined = determine(samples);
  EXPECT_TRUE(determined.meanD && determined.meanT);
  EXPECT_FALSE(determined.varianceD || determined.varianceT);
  const MotionModelOptions prior, fitted = fitMotionModel(samples, prior, determined);
  EXPECT_NE(fitted.distance.meanD, prior.distance.meanD);
  EXPECT_EQ(fitted.distance.varianceD, prior.distance.varianceD);
}

}  // namespace
}  // namespace hybrid_slam
