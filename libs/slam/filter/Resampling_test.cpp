#include "slam/filter/Resampling.h"

#include <gtest/gtest.h>
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/bayes/CParticleFilterData.h>
#include <mrpt/random/RandomGenerators.h>

#include <algorithm>
#include <functional>

namespace hybrid_slam {
namespace {

using mrpt::bayes::CParticleFilter;
using mrpt::bayes::CParticleFilterCapable;
using Scheme = CParticleFilter::TParticleResamplingAlgorithm;

constexpr int kRepetitions = 20000;
constexpr double kErrors = 5;  // standard errors

std::vector<double> logarithms(std::vector<double> weights) {
  for (double& w : weights) w = std::log(w);
  return weights;
}

std::vector<double> normalised(std::vector<double> weights) {
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
  return weights;
}

/// Very unequal, equal and nearly degenerate sets, of 1 to 40 particles.
std::vector<std::vector<double>> weightSets() {
  RandomStream random(1, 0, 0);
  std::vector<std::vector<double>> sets = {{1}, {1, 1, 1, 1}, {0.001, 0.999}, {0.5, 0.3, 0.2}};
  for (const size_t n : {5, 13, 40}) {
    std::vector<double> weights;
    for (size_t i = 0; i < n; ++i) weights.push_back(std::pow(random.uniform(), 4) + 1e-4);
    sets.push_back(weights);
  }
  for (auto& set : sets) set = normalised(set);
  return sets;
}

using Draw = std::function<std::vector<size_t>(const std::vector<double>& logWeights)>;

Draw mrptsDraw(Scheme scheme) {
  mrpt::random::getRandomGenerator().randomize(17);
  return [scheme](const std::vector<double>& logWeights) {
    std::vector<size_t> drawn;
    CParticleFilterCapable::computeResampling(scheme, logWeights, drawn);
    return drawn;
  };
}

std::vector<int> copies(const std::vector<size_t>& drawn, size_t n) {
  std::vector<int> counts(n, 0);
  for (const size_t i : drawn) ++counts.at(i);
  return counts;
}

/// The mean number of copies of each particle must be n w. `variance(n, w)` is that of one draw's count.
void expectCounts(const Draw& draw, const std::function<double(double n, double w)>& variance) {
  for (const auto& weights : weightSets()) {
    const size_t size = weights.size();
    const auto n = static_cast<double>(size);
    std::vector<double> sums(size, 0);
    const auto logWeights = logarithms(weights);
    for (int r = 0; r < kRepetitions; ++r) {
      const auto drawn = draw(logWeights);
      ASSERT_EQ(drawn.size(), size);
      const auto counts = copies(drawn, size);
      for (size_t i = 0; i < size; ++i) sums[i] += counts[i];
    }
    for (size_t i = 0; i < size; ++i)
      // MRPT's draws stop 1e-6 short of each stratum's end: n of these at the most.
      EXPECT_NEAR(sums[i] / kRepetitions, n * weights[i],
                  kErrors * std::sqrt(variance(n, weights[i]) / kRepetitions) + 1e-6 * n * n)
          << "particle " << i << " of " << size;
  }
}

/// Every draw gives at least floor(n w) copies, up to rounding.
void expectAtLeastTheWholePart(const Draw& draw, int slack) {
  for (const auto& weights : weightSets()) {
    const size_t size = weights.size();
    for (int r = 0; r < 200; ++r) {
      const auto counts = copies(draw(logarithms(weights)), size);
      for (size_t i = 0; i < size; ++i)
        ASSERT_GE(counts[i], std::floor(static_cast<double>(size) * (weights[i] - 1e-5)) - slack);
    }
  }
}

TEST(Resampling, MrptsMultinomialHasTheExpectedCounts) {
  expectCounts(mrptsDraw(CParticleFilter::prMultinomial), [](double n, double w) { return n * w * (1 - w); });
}

TEST(Resampling, MrptsStratifiedHasTheExpectedCounts) {
  // A weight covers some strata completely and at most two partly: two Bernoulli draws.
  expectCounts(mrptsDraw(CParticleFilter::prStratified), [](double, double) { return 0.5; });
  expectAtLeastTheWholePart(mrptsDraw(CParticleFilter::prStratified), 1);
}

TEST(Resampling, MrptsSystematicHasTheExpectedCounts) {
  // The count is the whole part of n w or one more: one Bernoulli draw.
  expectCounts(mrptsDraw(CParticleFilter::prSystematic), [](double, double) { return 0.25; });
  expectAtLeastTheWholePart(mrptsDraw(CParticleFilter::prSystematic), 0);
}

/// The pitfall: the random part takes the smallest of n sorted draws, so the first particles get too many
/// copies. If this test fails, MRPT has fixed it, and Resampling.h can be removed.
TEST(Resampling, MrptsResidualSchemeFavoursTheFirstParticles) {
  const std::vector<double> weights = {0.125, 0.125, 0.125, 0.625};  // n w = 0.5, 0.5, 0.5, 2.5
  const Draw draw = mrptsDraw(CParticleFilter::prResidual);
  std::vector<double> sums(4, 0);
  for (int r = 0; r < kRepetitions; ++r) {
    const auto counts = copies(draw(logarithms(weights)), 4);
    for (size_t i = 0; i < 4; ++i) sums[i] += counts[i];
  }
  // Two draws are left for four residuals of 1/4 each. Of four sorted uniform numbers the two smallest lie
  // below 1/4 with P = 1 - (3/4)^4 and 1 - (3/4)^4 - (3/4)^3: 0.945 draws on average instead of 0.5.
  const double expected = 2 - 2 * std::pow(0.75, 4) - std::pow(0.75, 3);
  EXPECT_NEAR(sums[0] / kRepetitions, expected, kErrors * std::sqrt(1.0 / kRepetitions));
}

TEST(Resampling, OurResidualSchemeHasTheExpectedCounts) {
  RandomStream random(2, 0, 0);
  const Draw draw = [&](const std::vector<double>& weights) { return residualResampling(weights, random); };
  // The residuals of n w sum up to R draws, each a Bernoulli draw of p = residual / R: at most n w of
  // variance.
  expectCounts(draw, [](double n, double w) { return std::max(n * w - std::floor(n * w), 1e-6); });
  expectAtLeastTheWholePart(draw, 0);
}

TEST(Resampling, OurResidualSchemeIsInvariantToTheScaleOfTheWeights) {
  const std::vector<double> logWeights = {-1000, -1001, -1002, -1e9};
  RandomStream a(3, 0, 0), b(3, 0, 0);
  const auto drawn = residualResampling(logWeights, a);
  EXPECT_EQ(drawn, residualResampling({0, -1, -2, -1e9}, b));
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
  EXPECT_EQ(std::count(drawn.begin(), drawn.end(), 3u), 0);
}

/// The smallest particle set that MRPT can resample.
struct Numbers
    : mrpt::bayes::CParticleFilterData<int>,
      mrpt::bayes::CParticleFilterDataImpl<Numbers, mrpt::bayes::CParticleFilterData<int>::CParticleList> {};

/// The pitfall that MrptParticles::performSubstitution works around: performResampling resets the weights of
/// only as many particles as were requested; with the default, 0, which means all, it resets none.
TEST(Resampling, MrptLeavesTheWeightsAsTheyWere) {
  Numbers particles;
  for (const double logWeight : {0.0, -1.0, -2.0, -3.0}) {
    particles.m_particles.emplace_back();
    particles.m_particles.back().d.reset(new int(static_cast<int>(-logWeight)));
    particles.m_particles.back().log_w = logWeight;
  }
  CParticleFilter::TParticleFilterOptions options;
  options.resamplingMethod = CParticleFilter::prSystematic;
  particles.performResampling(options);
  ASSERT_EQ(particles.m_particles.size(), 4u);
  for (const auto& particle : particles.m_particles) EXPECT_EQ(particle.log_w, -*particle.d);
}

/// The number of copies of a particle is its expected number rounded down or up, for any number of draws.
TEST(SystematicResampling, ToAnyNumber) {
  RandomStream random(3, 0, 0);
  for (const auto& weights : weightSets())
    for (const size_t count : {1, 3, 8, 60, 200}) {
      const auto drawn = systematicResampling(logarithms(weights), count, random);
      ASSERT_EQ(drawn.size(), count);
      EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
      const auto counts = copies(drawn, weights.size());
      for (size_t i = 0; i < weights.size(); ++i)
        EXPECT_LT(std::abs(counts[i] - static_cast<double>(count) * weights[i]), 1 + 1e-9);
    }
}

TEST(SystematicResampling, IsUnbiased) {
  RandomStream random(4, 0, 0);
  const std::vector<double> weights{0.5, 0.3, 0.2};
  std::vector<double> means(3, 0);
  for (int i = 0; i < kRepetitions; ++i)
    for (const size_t index : systematicResampling(logarithms(weights), 7, random))
      means[index] += 1.0 / kRepetitions;
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(means[i], 7 * weights[i], kErrors * 0.5 / std::sqrt(kRepetitions));  // a copy more or less
}

}  // namespace
}  // namespace hybrid_slam
