#include "readings/OdometryTrack.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>

namespace hybrid_slam::readings {
namespace {

constexpr size_t kMostReadings = 4000;  ///< no scan waits longer

}  // namespace

using mrpt::math::TPose2D;

TPose2D interpolate(const TPose2D& a, const TPose2D& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          mrpt::math::wrapToPi(a.phi + share * mrpt::math::wrapToPi(b.phi - a.phi))};
}

void OdometryTrack::add(double time, const TPose2D& pose) {
  if (!readings_.empty() && (time < end() || time - end() > maxGap_)) readings_.clear();
  if (!readings_.empty() && time == end()) readings_.pop_back();
  readings_.emplace_back(time, pose);
  if (readings_.size() > kMostReadings) readings_.pop_front();
}

TPose2D OdometryTrack::at(double time) const {
  if (readings_.size() == 1) return readings_.front().second;
  const auto after = std::lower_bound(readings_.begin() + 1, readings_.end() - 1, time,
                                      [](const Reading& one, double t) { return one.first < t; });
  const auto& [t1, b] = *after;
  const auto& [t0, a] = *(after - 1);
  // Two readings at nearly the same time tell no speed.
  return interpolate(a, b, std::max((time - t0) / (t1 - t0), -1.0));
}

}  // namespace hybrid_slam::readings
