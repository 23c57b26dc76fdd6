#include "base/RandomStream.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace hybrid_slam {
namespace {

constexpr int kDraws = 100000;
// Five standard errors: a correct generator fails one check in two million.
constexpr double kErrors = 5;

std::vector<double> draw(const std::function<double(int)>& next) {
  std::vector<double> values;
  for (int i = 0; i < kDraws; ++i) values.push_back(next(i));
  return values;
}

/// Mean of f over the values.
double mean(const std::vector<double>& values, const std::function<double(double)>& f) {
  double sum = 0;
  for (const double v : values) sum += f(v);
  return sum / static_cast<double>(values.size());
}

/// Correlation of two samples of uniform numbers (variance 1/12).
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return 12 * sum / static_cast<double>(a.size());
}

std::vector<double> uniforms(RandomStream stream) {
  return draw([&](int) { return stream.uniform(); });
}

void expectUniform(const std::vector<double>& values) {
  for (const double v : values) {
    ASSERT_GE(v, 0);
    ASSERT_LT(v, 1);
  }
  // Moments of the uniform distribution: E x = 1/2, E x^2 = 1/3 (variance 4/45), ten bins of p = 1/10.
  EXPECT_NEAR(mean(values, [](double v) { return v; }), 0.5, kErrors * std::sqrt(1.0 / 12 / kDraws));
  EXPECT_NEAR(mean(values, [](double v) { return v * v; }), 1.0 / 3, kErrors * std::sqrt(4.0 / 45 / kDraws));
  for (int bin = 0; bin < 10; ++bin)
    EXPECT_NEAR(mean(values, [bin](double v) { return static_cast<int>(10 * v) == bin ? 1.0 : 0.0; }), 0.1,
                kErrors * std::sqrt(0.09 / kDraws))
        << bin;
}

TEST(RandomStream, IsUniformAlongAStream) { expectUniform(uniforms({1, 2, 3})); }

TEST(RandomStream, IsUniformAcrossStreams) {
  expectUniform(draw([](int i) { return RandomStream(1, 1, static_cast<uint64_t>(i)).uniform(); }));
  expectUniform(draw([](int i) { return RandomStream(1, static_cast<uint64_t>(i), 1).uniform(); }));
  expectUniform(draw([](int i) { return RandomStream(static_cast<uint64_t>(i), 1, 1).uniform(); }));
}

TEST(RandomStream, GaussianHasTheMomentsOfTheStandardNormal) {
  RandomStream stream(7, 0, 0);
  const auto values = draw([&](int) { return stream.gaussian(); });
  // E x^k = 0, 1, 0, 3 and Var x^k = 1, 2, 15, 96 for k = 1..4.
  const double expected[] = {0, 1, 0, 3}, variance[] = {1, 2, 15, 96};
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(mean(values, [k](double v) { return std::pow(v, k); }), expected[k - 1],
                kErrors * std::sqrt(variance[k - 1] / kDraws))
        << k;
  // P(|x| < 1) = erf(1 / sqrt 2)
  const double p = std::erf(std::sqrt(0.5));
  EXPECT_NEAR(mean(values, [](double v) { return std::abs(v) < 1 ? 1.0 : 0.0; }), p,
              kErrors * std::sqrt(p * (1 - p) / kDraws));
}

TEST(RandomStream, SuccessiveDrawsAreUncorrelated) {
  const auto values = uniforms({3, 1, 4});
  for (size_t lag = 1; lag <= 3; ++lag) {
    const std::vector<double> later(values.begin() + static_cast<std::ptrdiff_t>(lag), values.end());
    const std::vector<double> earlier(values.begin(), values.end() - static_cast<std::ptrdiff_t>(lag));
    EXPECT_NEAR(correlation(earlier, later), 0, kErrors / std::sqrt(kDraws)) << lag;
  }
}

TEST(RandomStream, StreamsOfNeighbouringKeysAreUncorrelated) {
  const auto values = uniforms({5, 6, 7});
  for (const RandomStream& other : {RandomStream(6, 6, 7), RandomStream(5, 7, 7), RandomStream(5, 6, 8),
                                    RandomStream(6, 5, 7), RandomStream(7, 6, 5)})
    for (const auto& values2 : {uniforms(other)})
      EXPECT_NEAR(correlation(values, values2), 0, kErrors / std::sqrt(kDraws));
}

TEST(RandomStream, TheFirstDrawsOfNeighbouringParticlesAreUncorrelated) {
  const auto first = [](int i) { return RandomStream(1, 9, static_cast<uint64_t>(i)).uniform(); };
  EXPECT_NEAR(correlation(draw(first), draw([&](int i) { return first(i + 1); })), 0,
              kErrors / std::sqrt(kDraws));
}

TEST(RandomStream, TheSameKeyGivesTheSameNumbers) {
  RandomStream a(11, 12, 13), b(11, 12, 13);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(a.bits(), b.bits());
  RandomStream c(11, 12, 14);
  EXPECT_NE(a.bits(), c.bits());
}

}  // namespace
}  // namespace hybrid_slam
