#include "study/comparison/Statistics.h"

#include <algorithm>
#include <cmath>

#include "base/RandomStream.h"

namespace hybrid_slam::comparison {
namespace {

constexpr double kZ95 = 1.959963984540054;  // of the normal distribution

/// Twice the rank of each magnitude, so that mean ranks are integers.
std::vector<size_t> doubledRanks(const std::vector<double>& magnitudes) {
  std::vector<size_t> ranks;
  for (const double m : magnitudes) {
    size_t below = 0, equal = 0;
    for (const double other : magnitudes) below += other < m, equal += other == m;
    ranks.push_back(2 * below + equal + 1);
  }
  return ranks;
}

}  // namespace

double interpolatedQuantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double position = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(position);
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
}

Quartiles quartiles(const std::vector<double>& values) {
  return {interpolatedQuantile(values, 0.25), interpolatedQuantile(values, 0.5),
          interpolatedQuantile(values, 0.75)};
}

Interval wilsonInterval(size_t successes, size_t trials) {
  if (trials == 0) return {0, 1};
  const auto n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n, z2 = kZ95 * kZ95;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ95 * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n);
  return {successes == 0 ? 0 : centre - half, successes == trials ? 1 : centre + half};
}

double wilcoxonSignedRank(const std::vector<double>& differences) {
  std::vector<double> magnitudes;
  std::vector<bool> isPositive;
  for (const double d : differences)
    if (d != 0) magnitudes.push_back(std::abs(d)), isPositive.push_back(d > 0);
  const std::vector<size_t> ranks = doubledRanks(magnitudes);
  size_t positive = 0, total = 0;
  for (size_t i = 0; i < ranks.size(); ++i) total += ranks[i], positive += isPositive[i] ? ranks[i] : 0;

  // probability[s]: that the positive ranks sum to s if all signs are equally likely.
  std::vector<double> probability(total + 1, 0);
  probability[0] = 1;
  for (const size_t rank : ranks)
    for (size_t s = total + 1; s-- > 0;)
      probability[s] = 0.5 * probability[s] + (s >= rank ? 0.5 * probability[s - rank] : 0);

  double tail = 0;
  for (size_t s = 0; s <= std::min(positive, total - positive); ++s) tail += probability[s];
  return std::min(1.0, 2 * tail);
}

double signTest(const std::vector<double>& differences) {
  const auto plus = std::count_if(differences.begin(), differences.end(), [](double d) { return d > 0; });
  const auto minus = std::count_if(differences.begin(), differences.end(), [](double d) { return d < 0; });
  const auto n = static_cast<double>(plus + minus);
  double tail = 0;
  for (double k = 0; k <= static_cast<double>(std::min(plus, minus)); ++k)
    tail += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) - n * std::log(2.0));
  return std::min(1.0, 2 * tail);
}

std::optional<MedianRatio> medianRatio(const std::vector<double>& a, const std::vector<double>& b,
                                       uint64_t seed) {
  constexpr size_t kResamples = 2000;
  if (a.empty() || interpolatedQuantile(b, 0.5) == 0) return std::nullopt;
  MedianRatio result;
  result.ratio = interpolatedQuantile(a, 0.5) / interpolatedQuantile(b, 0.5);
  std::vector<double> ratios, resampledA(a.size()), resampledB(a.size());
  for (size_t r = 0; r < kResamples; ++r) {
    RandomStream random(seed, r, 0);
    for (size_t i = 0; i < a.size(); ++i) {
      const auto pair = static_cast<size_t>(random.uniform() * static_cast<double>(a.size()));
      resampledA[i] = a[pair], resampledB[i] = b[pair];
    }
    const double divisor = interpolatedQuantile(resampledB, 0.5);
    if (divisor == 0) return std::nullopt;
    ratios.push_back(interpolatedQuantile(resampledA, 0.5) / divisor);
  }
  result.interval = {interpolatedQuantile(ratios, 0.025), interpolatedQuantile(ratios, 0.975)};
  return result;
}

}  // namespace hybrid_slam::comparison
