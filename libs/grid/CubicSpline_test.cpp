#include "grid/CubicSpline.h"

#include <gtest/gtest.h>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

/// Sum of weight(k) k^power over the samples k = -1..2.
double moment(const std::array<double, 4>& weights, int power) {
  double sum = 0;
  for (int k = -1; k <= 2; ++k) sum += weights[static_cast<size_t>(k + 1)] * std::pow(k, power);
  return sum;
}

TEST(CubicSpline, KeepsConstantAndLinearFunctions) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const double t = random.uniform();
    const SplineWeights weights(t);
    for (const double w : weights.value) EXPECT_GE(w, 0);
    EXPECT_NEAR(moment(weights.value, 0), 1, 1e-14);
    EXPECT_NEAR(moment(weights.value, 1), t, 1e-14);
    EXPECT_NEAR(moment(weights.slope, 0), 0, 1e-14);
    EXPECT_NEAR(moment(weights.slope, 1), 1, 1e-14);
  }
}

/// The variance of the weights as a distribution is 1/3 at every t: sqrt(1/3) = 0.58 samples.
TEST(CubicSpline, BlursByTheSameEverywhere) {
  for (double t = 0; t < 1; t += 0.01)
    EXPECT_NEAR(moment(SplineWeights(t).value, 2) - t * t, 1.0 / 3, 1e-14) << t;
}

TEST(CubicSpline, TheSlopesAreTheDerivatives) {
  constexpr double kStep = 1e-5;
  for (double t = 0.01; t < 0.99; t += 0.01)
    for (size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(SplineWeights(t).slope[k],
                  (SplineWeights(t + kStep).value[k] - SplineWeights(t - kStep).value[k]) / (2 * kStep),
                  1e-9);
}

TEST(CubicSpline, GoesOnSmoothlyAtTheNextSample) {
  const SplineWeights end(1), start(0);
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(end.value[k + 1], start.value[k], 1e-15);
    EXPECT_NEAR(end.slope[k + 1], start.slope[k], 1e-15);
  }
  EXPECT_EQ(end.value[0], 0);
  EXPECT_EQ(start.value[3], 0);
}

}  // namespace
}  // namespace hybrid_slam
