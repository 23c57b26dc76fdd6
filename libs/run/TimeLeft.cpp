#include "run/TimeLeft.h"

#include <algorithm>

namespace hybrid_slam::run {

std::optional<double> TimeLeft::after(size_t scans, double elapsed) {
  constexpr double kFirstSeconds = 2, kFirstShare = 0.02, kResults = 0.25;
  const double done = static_cast<double>(scans), total = static_cast<double>(total_);
  if (done >= past_.back().first + total / 200) past_.emplace_back(done, elapsed);
  if (scans >= total_) return kResults * elapsed;
  if (elapsed < kFirstSeconds || done < kFirstShare * total) return {};
  const double b = std::max(0., 2 * (elapsed - 2 * timeOfHalf(done)) / (done * done));
  const double a = (elapsed - b * done * done) / done;
  return (1 + kResults) * total * (a + b * total) - elapsed;
}

double TimeLeft::timeOfHalf(double done) const {
  const auto next = std::lower_bound(past_.begin() + 1, past_.end(), std::pair(done / 2, 0.));
  if (next == past_.end()) return past_.back().second;
  const auto [scans, seconds] = *(next - 1);
  return seconds + (next->second - seconds) * (done / 2 - scans) / (next->first - scans);
}

}  // namespace hybrid_slam::run
