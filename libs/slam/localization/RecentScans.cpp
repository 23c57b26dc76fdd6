#include "slam/localization/RecentScans.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kSpacing = 0.5, kSpacingAngle = mrpt::DEG2RAD(20.0);
constexpr size_t kLocal = 8;  // scans of the local map
constexpr size_t kStride = 2;

}  // namespace

RecentScans::RecentScans(const FilterConfiguration& configuration, size_t most)
    : prepare_(configuration),
      grid_(decisive(configuration.grid)),
      motion_(configuration.motion),
      minFit_(configuration.improved.minFit),
      most_(most),
      matcher_(configuration.matcher) {}

bool RecentScans::add(const TPose2D& odometry, const PreparedScan& scan) {
  since_ = since_ + odometry;
  if (scans_.empty()) {
    scans_.push_back({{}, scan});
  } else {
    if (since_.norm() < kSpacing && std::abs(since_.phi) < kSpacingAngle) return false;
    const OccupancyGrid local = localMap();
    const TPose2D expected = scans_.back().pose + since_;
    const TPose2D pose = matched(expected, prepare_.withoutMovedThings(scan, expected, local), local);
    scans_.push_back({pose, prepare_.withoutMovedThings(scan, pose, local)});
  }
  if (scans_.size() > most_) scans_.pop_front();
  since_ = {};
  return true;
}

void RecentScans::keep(size_t count) {
  while (scans_.size() > count) scans_.pop_front();
}

OccupancyGrid RecentScans::localMap() const {
  OccupancyGrid local(grid_.resolution);
  for (size_t i = scans_.size() - std::min(kLocal, scans_.size()); i < scans_.size(); ++i)
    local.insert(scans_[i].scan.beams, scans_[i].pose, grid_);
  return local;
}

TPose2D RecentScans::matched(const TPose2D& expected, const PreparedScan& scan,
                             const OccupancyGrid& local) const {
  const MotionDistribution motion = motionDistribution(scans_.back().pose, since_, motion_);
  Eigen::Matrix3d covariance = motion.covariance;
  covariance.diagonal().array() += 1e-8;
  const Eigen::Matrix3d information = covariance.inverse();
  const ScanMatch match = matcher_.match(scan.matchedBeams, expected, local, [&](const TPose2D& pose) {
    return gaussianLogDensity(pose, expected, information);
  });
  return match.fit >= minFit_ ? match.pose : expected;
}

// The newest scan and earlier ones, as far apart as kStride allows.
std::vector<size_t> RecentScans::spread() const {
  std::vector<size_t> chosen;
  size_t lasers = 0;
  const size_t stride = std::clamp<size_t>(scans_.size() / kMaxLasers, 1, kStride);
  for (size_t age = 0; age < scans_.size(); age += stride) {
    lasers += scans_[scans_.size() - 1 - age].scan.matchedBeams.origins.size();
    if (lasers > kMaxLasers) break;
    chosen.push_back(scans_.size() - 1 - age);
  }
  return chosen;
}

ScanBeams RecentScans::joined() const {
  ScanBeams all{LaserScans()};
  for (const size_t i : spread()) {
    const TPose2D pose = motion(scans_.size() - 1, i);
    const double c = std::cos(pose.phi), s = std::sin(pose.phi);
    const ScanBeams& beams = scans_[i].scan.matchedBeams;
    for (ScanBeams::Ray ray : beams.rays) {
      ray.laser += all.origins.size();
      std::tie(ray.dirX, ray.dirY) = std::pair(c * ray.dirX - s * ray.dirY, s * ray.dirX + c * ray.dirY);
      all.rays.push_back(ray);
    }
    for (const mrpt::math::TPoint2D& origin : beams.origins) all.origins.push_back(pose.composePoint(origin));
  }
  return all;
}

std::vector<LineSegment> RecentScans::lines() const {
  std::vector<LineSegment> all;
  for (const size_t i : spread()) {
    const auto lines = transformed(scans_[i].scan.lines, motion(scans_.size() - 1, i));
    all.insert(all.end(), lines.begin(), lines.end());
  }
  return all;
}

std::vector<mrpt::math::TPoint2D> RecentScans::endPoints() const {
  std::vector<mrpt::math::TPoint2D> all;
  for (size_t i = scans_.size(); i-- > 0;)
    for (const mrpt::math::TPoint2D& p : scans_[i].scan.matchedBeams.endPoints())
      all.push_back(motion(scans_.size() - 1, i).composePoint(p));
  return all;
}

}  // namespace hybrid_slam
