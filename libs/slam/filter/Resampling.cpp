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

}  // namespace hybrid_slam
