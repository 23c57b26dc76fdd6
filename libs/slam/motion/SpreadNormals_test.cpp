#include "slam/motion/SpreadNormals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace hybrid_slam {
namespace {

TEST(SpreadNormals, OneParticlesNumbersAreStandardNormalAndIndependent) {
  for (const size_t particle : {0u, 1u, 7u, 4999u}) {
    constexpr int kSteps = 20000;
    std::array<double, 3> sum{}, squares{}, fourth{}, product{};
    for (int step = 0; step < kSteps; ++step) {
      const auto normals = SpreadNormals(RandomStream(1, step, 0))(particle);
      for (size_t k = 0; k < 3; ++k) {
        sum[k] += normals[k], squares[k] += normals[k] * normals[k];
        fourth[k] += std::pow(normals[k], 4), product[k] += normals[k] * normals[(k + 1) % 3];
      }
    }
    for (size_t k = 0; k < 3; ++k) {  // four standard errors
      EXPECT_NEAR(sum[k] / kSteps, 0, 4 / std::sqrt(kSteps));
      EXPECT_NEAR(squares[k] / kSteps, 1, 4 * std::sqrt(2.0 / kSteps));
      EXPECT_NEAR(fourth[k] / kSteps, 3, 4 * std::sqrt(96.0 / kSteps));
      EXPECT_NEAR(product[k] / kSteps, 0, 4 / std::sqrt(kSteps));
    }
  }
}

/// Copies of a particle have consecutive indices and must not draw nearly the same numbers. The nearest of 20
/// independent points of the unit cube are 0.096 apart in the median, of 50 0.049.
TEST(SpreadNormals, ConsecutiveParticlesDrawDifferentNumbers) {
  for (const size_t first : {0u, 3u, 4000u})
    for (const auto& [count, apart] : {std::pair{4u, 0.5}, std::pair{20u, 0.28}, std::pair{50u, 0.19}}) {
      const SpreadNormals normals(RandomStream(2, first, count));
      std::vector<std::array<double, 3>> points;
      for (size_t i = first; i < first + count; ++i) {
        points.push_back(normals(i));
        for (double& u : points.back()) u = 0.5 * std::erfc(-u / M_SQRT2);
      }
      for (size_t i = 0; i < count; ++i)
        for (size_t j = 0; j < i; ++j) {
          double squares = 0;
          for (size_t k = 0; k < 3; ++k) {
            const double d = std::abs(points[i][k] - points[j][k]);
            squares += std::pow(std::min(d, 1 - d), 2);
          }
          ASSERT_GT(std::sqrt(squares), apart) << first << " " << i << " " << j;
        }
    }
}

/// Purpose: the mean likelihood of a scan over the particles is close to its expectation. The likelihood here
/// is exp(-(D^2 + C^2 + T^2) / 2), with the mean m = 2^-1.5 and the variance 3^-1.5 - m^2.
TEST(SpreadNormals, TheMeanOfALikelihoodVariesLessThanOverIndependentDraws) {
  constexpr int kSteps = 2000;
  constexpr size_t kParticles = 20;
  const double mean = std::pow(2, -1.5), variance = std::pow(3, -1.5) - mean * mean;
  double squares = 0;
  for (int step = 0; step < kSteps; ++step) {
    const SpreadNormals normals(RandomStream(3, step, 0));
    double sum = 0;
    for (size_t i = 0; i < kParticles; ++i) {
      const auto n = normals(i);
      sum += std::exp(-0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    }
    squares += std::pow(sum / kParticles - mean, 2) / kSteps;
  }
  EXPECT_LT(squares, 0.35 * variance / kParticles);  // 0.22 expected
}

TEST(SpreadNormals, AreFinite) {
  for (int step = 0; step < 1000; ++step)
    for (size_t i = 0; i < 1000; i += 13)
      for (const double normal : SpreadNormals(RandomStream(4, step, 0))(i))
        ASSERT_TRUE(std::isfinite(normal));
}

}  // namespace
}  // namespace hybrid_slam
