#include "run/TrajectoryRecorder.h"

#include <cmath>

#include "base/PoseOffset.h"

namespace hybrid_slam::run {

using mrpt::math::TPose2D;

void TrajectoryRecorder::add(double timestamp, const TPose2D& motion, size_t updates) {
  const TPose2D before = scans_.empty() ? TPose2D() : scans_.back().odometry;
  scans_.push_back({timestamp, before + motion, updates});
  distance_ += motion.norm();
}

files::Trajectory TrajectoryRecorder::trajectory(const std::vector<TPose2D>& path) const {
  files::Trajectory out;
  out.reserve(scans_.size());
  for (const Scan& scan : scans_) out.push_back({scan.timestamp, scan.odometry});
  if (path.empty()) return out;

  const std::vector<size_t> anchors = scansOfUpdates();
  for (size_t i = 0; i < anchors.front(); ++i)
    out[i].pose = path.front() + (scans_[i].odometry - scans_[anchors.front()].odometry);
  for (size_t k = 0; k < anchors.size(); ++k) {
    const size_t from = anchors[k], to = k + 1 < anchors.size() ? anchors[k + 1] : scans_.size();
    const auto carried = [&](size_t i) { return path[k] + (scans_[i].odometry - scans_[from].odometry); };
    Eigen::Vector3d error = Eigen::Vector3d::Zero();
    if (to < scans_.size()) error = offsetOf(path[k + 1], carried(to));
    // A robot that stands makes no errors: share by motion, or by scans if the odometry says that none moved
    // it.
    std::vector<double> travelled(1, 0);
    for (size_t i = from + 1; i < std::min(to + 1, scans_.size()); ++i) {
      const TPose2D step = scans_[i].odometry - scans_[i - 1].odometry;
      travelled.push_back(travelled.back() + step.norm() + std::abs(step.phi));  // m; 1 m for a radian
    }
    for (size_t i = from; i < to; ++i) {
      const double share = travelled.back() > 0
                               ? travelled[i - from] / travelled.back()
                               : static_cast<double>(i - from) / static_cast<double>(to - from);
      out[i].pose = displaced(carried(i), share * error);
    }
  }
  return out;
}

std::vector<TPose2D> TrajectoryRecorder::motions() const {
  std::vector<TPose2D> all;
  for (size_t i = 1; i < scans_.size(); ++i) all.push_back(scans_[i].odometry - scans_[i - 1].odometry);
  return all;
}

std::vector<TPose2D> TrajectoryRecorder::motionsOfUpdates() const {
  const std::vector<size_t> anchors = scansOfUpdates();
  std::vector<TPose2D> all(anchors.size());
  for (size_t k = 1; k < anchors.size(); ++k)
    all[k] = scans_[anchors[k]].odometry - scans_[anchors[k - 1]].odometry;
  return all;
}

std::vector<size_t> TrajectoryRecorder::scansOfUpdates() const {
  std::vector<size_t> all;
  for (size_t i = 0; i < scans_.size(); ++i)
    if (scans_[i].updates > (i == 0 ? 0 : scans_[i - 1].updates)) all.push_back(i);
  return all;
}

std::vector<size_t> TrajectoryRecorder::updates() const {
  std::vector<size_t> all;
  for (const Scan& scan : scans_) all.push_back(scan.updates);
  return all;
}

}  // namespace hybrid_slam::run
