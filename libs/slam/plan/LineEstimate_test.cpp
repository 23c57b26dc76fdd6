#include "slam/plan/LineEstimate.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace hybrid_slam {
namespace {

TEST(LineEstimate, TwoEqualEstimatesHalveTheCovariance) {
  const LineEstimate line = lineThrough({3, 4}, 0.7, 2, 0.02);
  const LineEstimate both = fused(line, line);
  EXPECT_NEAR(both.covariance(0, 0), line.covariance(0, 0) / 2, 1e-12);
  EXPECT_NEAR(both.covariance(1, 1), line.covariance(1, 1) / 2, 1e-12);
  EXPECT_NEAR(both.offset(line.at), 0, 1e-12);
  EXPECT_DOUBLE_EQ(both.angle, 0.7);
}

TEST(LineEstimate, TwoPiecesOfALineGiveTheLineThroughTheirMiddles) {
  // Pieces without a direction of their own, 10 m apart, 0.1 m aside.
  LineEstimate a = lineThrough({0, 0}, 0, 1, 0.01), b = lineThrough({10, 0.1}, 0, 1, 0.01);
  a.covariance(1, 1) = b.covariance(1, 1) = 1;
  const LineEstimate both = fused(a, b);
  EXPECT_NEAR(std::tan(both.angle), 0.01, 1e-5);
  EXPECT_NEAR(both.offset({0, 0}), 0, 1e-4);
  EXPECT_NEAR(both.offset({10, 0.1}), 0, 1e-4);
  EXPECT_NEAR(both.along({5, 0.05}), 0, 0.01);
  // Two offsets of variance v, 10 m apart: v / 2 in the middle and 2 v / 100 of the angle.
  EXPECT_NEAR(both.covariance(0, 0), a.covariance(0, 0) / 2, 1e-8);
  EXPECT_NEAR(both.covariance(1, 1), 2 * a.covariance(0, 0) / 100, 1e-8);
}

TEST(LineEstimate, DistanceIsThatOfTheDifferenceInStandardDeviations) {
  const LineEstimate a = lineThrough({0, 0}, 0, 1, 0.01);
  LineEstimate b = a;
  b.at.y = 3 * std::sqrt(2 * a.covariance(0, 0));
  EXPECT_NEAR(squaredDistance(a, b), 9, 1e-9);
  EXPECT_NEAR(squaredDistance(a.reversed(), b.reversed()), 9, 1e-9);
}

TEST(LineEstimate, TurnedLineKeepsItsMiddleAndLosesVariance) {
  const LineEstimate line = lineThrough({1, 2}, 0.1, 1, 0.01);
  const LineEstimate turned = turnedTo(line, 0.12, 1e-8);
  EXPECT_DOUBLE_EQ(turned.angle, 0.12);
  EXPECT_NEAR((turned.at - line.at).norm(), 0, 1e-12);
  EXPECT_LT(turned.covariance(1, 1), 1.1e-8);
}

TEST(LineEstimate, FusedCovariancesStayPositive) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    LineEstimate line =
        lineThrough({uniform(random), uniform(random)}, uniform(random), 5 * uniform(random), 0.01);
    for (int j = 0; j < 20; ++j) {
      const double s = 100 * uniform(random);
      line = fused(
          line, lineThrough(line.point(s), line.angle + 0.01 * uniform(random), 5 * uniform(random), 0.01));
      ASSERT_TRUE(std::isfinite(line.at.x + line.at.y + line.angle));
      ASSERT_GT(line.covariance(0, 0), 0);
      ASSERT_GT(line.covariance.determinant(), 0);
    }
  }
}

}  // namespace
}  // namespace hybrid_slam
