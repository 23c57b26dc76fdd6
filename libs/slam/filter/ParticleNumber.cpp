#include "slam/filter/ParticleNumber.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace hybrid_slam {

double kldParticles(double bins) {
  const double k = bins - 1;
  if (k <= 0) return 1;
  const double a = 2 / (9 * k);
  return k / (2 * kDivergence) * std::pow(std::max(0.0, 1 - a + std::sqrt(a) * kQuantile), 3);
}

double occupiedBins(const std::vector<WeightedPose>& particles) {
  // Around the best particle, so that one narrow cloud is one bin wherever it stands.
  const WeightedPose best = *std::max_element(
      particles.begin(), particles.end(),
      [](const WeightedPose& a, const WeightedPose& b) { return a.logWeight < b.logWeight; });
  std::map<std::array<long, 3>, double> weights;
  double sum = 0;
  for (const auto& [pose, logWeight] : particles) {
    const double weight = std::exp(logWeight - best.logWeight);
    weights[{std::lround((pose.x - best.pose.x) / kBinSize), std::lround((pose.y - best.pose.y) / kBinSize),
             std::lround(mrpt::math::wrapToPi(pose.phi - best.pose.phi) / kBinAngle)}] += weight;
    sum += weight;
  }
  double entropy = 0;
  for (const auto& [bin, weight] : weights)
    if (weight > 0) entropy -= weight / sum * std::log(weight / sum);
  return std::exp(entropy);
}

}  // namespace hybrid_slam
