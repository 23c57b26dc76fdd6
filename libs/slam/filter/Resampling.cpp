#include "slam/filter/Resampling.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

std::vector<size_t> residualResampling(const std::vector<double>& logWeights, RandomStream& random) {
  const size_t n = logWeights.size();
  const double greatest = *std::max_element(logWeights.begin(), logWeights.end());
  double sum = 0;
  for (const double w : logWeights) sum += std::exp(w - greatest);

  std::vector<size_t> drawn;
  std::vector<double> residuals;  // cumulative
  double cumulated = 0;
  for (size_t i = 0; i < n; ++i) {
    const double copies = static_cast<double>(n) * std::exp(logWeights[i] - greatest) / sum;
    drawn.insert(drawn.end(), static_cast<size_t>(copies), i);
    residuals.push_back(cumulated += copies - std::floor(copies));
  }
  while (drawn.size() < n) {
    const auto at = std::upper_bound(residuals.begin(), residuals.end() - 1, cumulated * random.uniform());
    drawn.push_back(static_cast<size_t>(at - residuals.begin()));
  }
  std::sort(drawn.begin(), drawn.end());
  return drawn;
}

std::vector<size_t> systematicResampling(const std::vector<double>& logWeights, size_t count,
                                         RandomStream& random) {
  const double greatest = *std::max_element(logWeights.begin(), logWeights.end());
  double sum = 0;
  for (const double w : logWeights) sum += std::exp(w - greatest);

  const double step = sum / static_cast<double>(count), offset = random.uniform();
  std::vector<size_t> drawn;
  double cumulated = 0;
  for (size_t i = 0; i < logWeights.size(); ++i) {
    cumulated += std::exp(logWeights[i] - greatest);
    while (drawn.size() < count && step * (static_cast<double>(drawn.size()) + offset) < cumulated)
      drawn.push_back(i);
  }
  drawn.resize(count, logWeights.size() - 1);  // rounding may leave the last point beyond the sum
  return drawn;
}

}  // namespace hybrid_slam
