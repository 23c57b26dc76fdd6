#include "study/comparison/Statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/RandomStream.h"

namespace hybrid_slam::comparison {
namespace {

TEST(Quantile, TypeSevenByHand) {
  const Quartiles odd = quartiles({5, 1, 4, 2, 3});
  EXPECT_EQ(odd.lower, 2);
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.upper, 4);
  const Quartiles even = quartiles({1, 2, 3, 4});  // R: quantile(1:4)
  EXPECT_DOUBLE_EQ(even.lower, 1.75);
  EXPECT_DOUBLE_EQ(even.median, 2.5);
  EXPECT_DOUBLE_EQ(even.upper, 3.25);
  EXPECT_EQ(interpolatedQuantile({7}, 0.25), 7);
  EXPECT_EQ(interpolatedQuantile({3, 9}, 0), 3);
  EXPECT_EQ(interpolatedQuantile({3, 9}, 1), 9);
}

// Newcombe, "Two-sided confidence intervals for the single proportion", 1998, table I, method 3.
TEST(WilsonInterval, AgreesWithThePublishedTable) {
  const struct {
    size_t successes, trials;
    double low, high;
  } rows[] = {
      {81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0, 0.1611}, {1, 29, 0.0061, 0.1718}};
  for (const auto& row : rows) {
    const Interval i = wilsonInterval(row.successes, row.trials);
    EXPECT_NEAR(i.low, row.low, 5e-5);
    EXPECT_NEAR(i.high, row.high, 5e-5);
    const Interval mirrored = wilsonInterval(row.trials - row.successes, row.trials);
    EXPECT_NEAR(mirrored.low, 1 - i.high, 1e-12);
    EXPECT_NEAR(mirrored.high, 1 - i.low, 1e-12);
  }
  EXPECT_EQ(wilsonInterval(0, 0).low, 0);
  EXPECT_EQ(wilsonInterval(0, 0).high, 1);
}

// Hollander & Wolfe 1973, p. 29: depression scale of nine patients before and after; one-sided p = 0.01953.
TEST(WilcoxonSignedRank, AgreesWithThePublishedExample) {
  const std::vector<double> before{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30},
      after{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (size_t i = 0; i < before.size(); ++i) differences.push_back(after[i] - before[i]);
  EXPECT_NEAR(wilcoxonSignedRank(differences), 2 * 0.01953125, 1e-12);
  for (double& d : differences) d = -d;
  EXPECT_NEAR(wilcoxonSignedRank(differences), 2 * 0.01953125, 1e-12);
}

TEST(WilcoxonSignedRank, ByHand) {
  EXPECT_EQ(wilcoxonSignedRank({}), 1);
  EXPECT_EQ(wilcoxonSignedRank({0, 0}), 1);
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({1, 2, 3, 4, 5, 6, 7, 8}), 2.0 / 256);
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({0, 1, 2, 3, 4, 5, 6, 7, 8}), 2.0 / 256);  // the zero does not count
  EXPECT_DOUBLE_EQ(wilcoxonSignedRank({1, -1}), 1);
}

TEST(WilcoxonSignedRank, IsTheShareOfSignsAtLeastAsExtreme) {
  for (uint64_t round = 0; round < 60; ++round) {
    RandomStream random(1, round, 0);
    std::vector<double> d;
    for (uint64_t i = 0; i < 1 + round % 10; ++i)
      d.push_back(std::round(8 * random.gaussian()));  // with ties and zeros
    d.erase(std::remove(d.begin(), d.end(), 0.0), d.end());
    std::vector<double> ranks;
    for (const double x : d) {
      double rank = 0.5;
      for (const double other : d)
        rank += std::abs(other) < std::abs(x) ? 1 : std::abs(other) == std::abs(x) ? 0.5 : 0;
      ranks.push_back(rank);
    }
    const auto positiveSum = [&](auto isPositive) {
      double sum = 0;
      for (size_t i = 0; i < d.size(); ++i) sum += isPositive(i) ? ranks[i] : 0;
      return sum;
    };
    double total = 0;
    for (const double r : ranks) total += r;
    const double seen = positiveSum([&](size_t i) { return d[i] > 0; });
    size_t asFar = 0;
    for (size_t signs = 0; signs < (size_t{1} << d.size()); ++signs) {
      const double sum = positiveSum([&](size_t i) { return signs >> i & 1; });
      asFar += std::abs(sum - total / 2) >= std::abs(seen - total / 2) - 1e-9;
    }
    EXPECT_NEAR(wilcoxonSignedRank(d),
                static_cast<double>(asFar) / std::pow(2, static_cast<double>(d.size())), 1e-9)
        << round;
  }
}

TEST(SignTest, ByHand) {
  EXPECT_DOUBLE_EQ(signTest({}), 1);
  EXPECT_DOUBLE_EQ(signTest({0, 0, 0}), 1);
  EXPECT_NEAR(signTest({1, 1, 1, 1, 1}), 2.0 / 32, 1e-12);
  EXPECT_NEAR(signTest({-1, -1, -1, -1, 0, 2}), 2 * (1 + 5) / 32.0, 1e-12);
  // Hollander & Wolfe's depression data: 2 of 9 go up.
  EXPECT_NEAR(signTest({1, 1, -1, -1, -1, -1, -1, -1, -1}), 2 * (1 + 9 + 36) / 512.0, 1e-12);
  EXPECT_DOUBLE_EQ(signTest({1, -1, 1, -1}), 1);
}

TEST(MedianRatio, ProportionalSamplesGiveAnIntervalOfWidthZero) {
  const std::vector<double> b{1, 2, 3, 4, 5, 6};
  std::vector<double> a;
  for (const double x : b) a.push_back(0.25 * x);
  const auto ratio = medianRatio(a, b, 1);
  ASSERT_TRUE(ratio);
  EXPECT_DOUBLE_EQ(ratio->ratio, 0.25);
  EXPECT_DOUBLE_EQ(ratio->interval.low, 0.25);  // pairs stay together in a resample
  EXPECT_DOUBLE_EQ(ratio->interval.high, 0.25);
}

TEST(MedianRatio, IntervalHasItsNominalCoverage) {
  size_t held = 0;
  constexpr size_t kRounds = 200;
  for (size_t round = 0; round < kRounds; ++round) {
    RandomStream random(2, round, 0);
    std::vector<double> a, b;
    for (int i = 0; i < 30; ++i) {
      a.push_back(2 * std::exp(0.5 * random.gaussian()));
      b.push_back(std::exp(0.5 * random.gaussian()));
    }
    const auto ratio = medianRatio(a, b, round);
    ASSERT_TRUE(ratio);
    held += ratio->interval.low <= 2 && 2 <= ratio->interval.high;
  }
  EXPECT_GE(held, kRounds * 88 / 100);
  EXPECT_LT(held, kRounds);
}

TEST(MedianRatio, SameSeedSameIntervalAndAMedianOfZeroGivesNone) {
  const std::vector<double> a{1, 5, 2, 8, 3}, b{2, 2, 7, 1, 9};
  const auto first = medianRatio(a, b, 3), again = medianRatio(a, b, 3);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->interval.low, again->interval.low);
  EXPECT_EQ(first->interval.high, again->interval.high);
  EXPECT_LE(first->interval.low, first->ratio);
  EXPECT_GE(first->interval.high, first->ratio);
  EXPECT_FALSE(medianRatio({}, {}, 1));
  EXPECT_FALSE(medianRatio({1, 2, 3}, {0, 0, 0}, 1));
}

}  // namespace
}  // namespace hybrid_slam::comparison
