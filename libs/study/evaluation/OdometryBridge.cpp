#include "study/evaluation/OdometryBridge.h"

#include <algorithm>
#include <iterator>

#include "base/PoseOffset.h"

namespace hybrid_slam::evaluation {

OdometryBridge::OdometryBridge(const files::Trajectory& trajectory, const files::Trajectory& odometry,
                               double tolerance)
    : odometry_(odometry), rows_(odometry), tolerance_(std::min(tolerance, kWidestTolerance)) {
  for (size_t i = 0; i < trajectory.size(); ++i)
    if (const auto row = rows_.nearest(trajectory[i].timestamp, tolerance_))
      anchors_.insert_or_assign(*row, TrajectoryPoint{trajectory[i].pose, i});
}

std::optional<TrajectoryPoint> OdometryBridge::poseAt(double timestamp) const {
  const auto row = rows_.nearest(timestamp, tolerance_);
  if (!row) return std::nullopt;
  const auto next = anchors_.upper_bound(*row);
  if (next == anchors_.begin()) return std::nullopt;
  const auto last = std::prev(next);
  const auto carriedTo = [&](size_t target) {
    return last->second.pose + (odometry_[target].pose - odometry_[last->first].pose);
  };

  const mrpt::math::TPose2D pose = carriedTo(*row);
  if (next == anchors_.end()) return TrajectoryPoint{pose, last->second.row};
  const double share =
      static_cast<double>(*row - last->first) / static_cast<double>(next->first - last->first);
  const Eigen::Vector3d error = offsetOf(next->second.pose, carriedTo(next->first));
  return TrajectoryPoint{displaced(pose, share * error), last->second.row};
}

}  // namespace hybrid_slam::evaluation
