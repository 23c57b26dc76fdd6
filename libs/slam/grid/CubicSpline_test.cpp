#include "slam/grid/CubicSpline.h"

#include <gtest/gtest.h>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

constexpr double kSingle = 5e-7;  // a few single-precision rounding errors

/// Sum of weight(k) k^power over the samples k = -1..2.
double moment(const Float4& weights, int power) {
  double sum = 0;
  for (int k = -1; k <= 2; ++k) sum += static_cast<double>(weights[k + 1]) * std::pow(k, power);
  return sum;
}

TEST(CubicSpline, KeepsConstantAndLinearFunctions) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto t = static_cast<float>(random.uniform());
    const SplineWeights weights(t);
    for (int k = 0; k < 4; ++k) EXPECT_GE(weights.value[k], -kSingle);
    EXPECT_NEAR(moment(weights.value, 0), 1, kSingle);
    EXPECT_NEAR(moment(weights.value, 1), t, kSingle);
    EXPECT_NEAR(moment(weights.slope, 0), 0, kSingle);
    EXPECT_NEAR(moment(weights.slope, 1), 1, kSingle);
  }
}

/// The variance of the weights as a distribution is 1/3 at every t: sqrt(1/3) = 0.58 samples.
TEST(CubicSpline, BlursByTheSameEverywhere) {
  for (float t = 0; t < 1; t += 0.01f)
    EXPECT_NEAR(moment(SplineWeights(t).value, 2) - t * t, 1.0 / 3, kSingle) << t;
}

TEST(CubicSpline, TheSlopesAreTheDerivatives) {
  // The error of the difference is kStep^2 / 6 of the third derivative, 3: 5e-5; of its rounding, 1e-7 /
  // kStep.
  constexpr float kStep = 0.01f;
  for (float t = 0.02f; t < 0.98f; t += 0.01f)
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(SplineWeights(t).slope[k],
                  (SplineWeights(t + kStep).value[k] - SplineWeights(t - kStep).value[k]) / (2 * kStep),
                  1e-4);
}

TEST(CubicSpline, GoesOnSmoothlyAtTheNextSample) {
  const SplineWeights end(1), start(0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(end.value[k + 1], start.value[k], kSingle);
    EXPECT_NEAR(end.slope[k + 1], start.slope[k], kSingle);
  }
  EXPECT_NEAR(end.value[0], 0, kSingle);
  EXPECT_EQ(start.value[3], 0);
}

}  // namespace
}  // namespace hybrid_slam
