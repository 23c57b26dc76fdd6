#include "study/evaluation/OdometryBridge.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <iterator>

namespace hybrid_slam::evaluation {

OdometryBridge::OdometryBridge(const files::Trajectory& trajectory, const files::Trajectory& odometry,
                               double tolerance)
    : odometry_(odometry), rows_(odometry), tolerance_(std::min(tolerance, kWidestTolerance)) {
  for (const files::StampedPose& p : trajectory)
    if (const auto row = rows_.nearest(p.timestamp, tolerance_)) anchors_.insert_or_assign(*row, p.pose);
}

std::optional<mrpt::math::TPose2D> OdometryBridge::poseAt(double timestamp) const {
  const auto row = rows_.nearest(timestamp, tolerance_);
  if (!row) return std::nullopt;
  const auto next = anchors_.upper_bound(*row);
  if (next == anchors_.begin()) return std::nullopt;
  const auto last = std::prev(next);
  const auto carriedTo = [&](size_t target) {
    return last->second + (odometry_[target].pose - odometry_[last->first].pose);
  };

  mrpt::math::TPose2D pose = carriedTo(*row);
  if (next == anchors_.end()) return pose;
  const mrpt::math::TPose2D missed = carriedTo(next->first);
  const double share =
      static_cast<double>(*row - last->first) / static_cast<double>(next->first - last->first);
  pose.x += share * (next->second.x - missed.x);
  pose.y += share * (next->second.y - missed.y);
  pose.phi += share * mrpt::math::wrapToPi(next->second.phi - missed.phi);
  return pose;
}

}  // namespace hybrid_slam::evaluation
