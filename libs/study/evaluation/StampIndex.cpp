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

StampIndex::Stamps::const_iterator StampIndex::find(double timestamp, double tolerance) const {
  const auto after = std::upper_bound(stamps_.begin(), stamps_.end(),
                                      std::make_pair(timestamp, std::numeric_limits<size_t>::max()));
  auto best = stamps_.end();
  if (after != stamps_.begin()) best = after - 1;
  if (after != stamps_.end() && (best == stamps_.end() || after->first - timestamp < timestamp - best->first))
    best = after;
  return best != stamps_.end() && std::abs(best->first - timestamp) <= tolerance ? best : stamps_.end();
}

std::optional<size_t> StampIndex::nearest(double timestamp, double tolerance) const {
  const auto found = find(timestamp, tolerance);
  return found == stamps_.end() ? std::nullopt : std::optional<size_t>(found->second);
}

std::optional<size_t> StampSequence::next(double timestamp) {
  const auto found = index_.find(timestamp, tolerance_);
  if (found == index_.stamps_.end()) return std::nullopt;
  const auto [first, end] = std::equal_range(index_.stamps_.begin(), index_.stamps_.end(), *found,
                                             [](const auto& a, const auto& b) { return a.first < b.first; });
  return (first + std::min(times_[timestamp]++, end - first - 1))->second;
}

}  // namespace hybrid_slam::evaluation
