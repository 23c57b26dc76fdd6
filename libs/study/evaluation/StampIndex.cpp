#include "study/evaluation/StampIndex.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybrid_slam::evaluation {

StampIndex::StampIndex(const files::Trajectory& trajectory) {
  stamps_.reserve(trajectory.size());
  for (size_t row = 0; row < trajectory.size(); ++row) stamps_.emplace_back(trajectory[row].timestamp, row);
  std::sort(stamps_.begin(), stamps_.end());  // equal stamps stay in file order: the row is the second key
}

std::optional<size_t> StampIndex::nearest(double timestamp, double tolerance) const {
  const auto after = std::upper_bound(stamps_.begin(), stamps_.end(),
                                      std::make_pair(timestamp, std::numeric_limits<size_t>::max()));
  auto best = stamps_.end();
  if (after != stamps_.begin()) best = after - 1;
  if (after != stamps_.end() && (best == stamps_.end() || after->first - timestamp < timestamp - best->first))
    best = after;
  if (best == stamps_.end() || !(std::abs(best->first - timestamp) <= tolerance)) return std::nullopt;
  return best->second;
}

}  // namespace hybrid_slam::evaluation
