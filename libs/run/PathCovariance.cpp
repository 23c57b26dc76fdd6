#include "run/PathCovariance.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Numbers.h"

namespace hybrid_slam::run {

using mrpt::math::TPose2D;

namespace {

constexpr double square(double x) { return x * x; }

// Tuned on simulated logs: doc/verdict.md.
constexpr double kMatch = 0.01, kMatchAngle = mrpt::DEG2RAD(0.09);            // of a scan match
constexpr double kDrift = 0.002, kDriftAngle = mrpt::DEG2RAD(0.008);          // per sqrt(m), with lines
constexpr double kOpenDrift = 0.003, kOpenDriftAngle = mrpt::DEG2RAD(0.048);  // the same, without
constexpr double kBetween = 0.02, kBetweenAngle = mrpt::DEG2RAD(1.0);         // per sqrt(m), odometry alone
constexpr double kLoops = 4, kNear = 3, kReturn = 20;                         // m

Eigen::Matrix3d diagonal(double position, double heading) {
  return Eigen::Vector3d(square(position), square(position), square(heading)).asDiagonal();
}

/// The motion since an update.
Eigen::Matrix3d ofMotion(const TPose2D& since) {
  const double root = std::sqrt(since.norm());
  return diagonal(kBetween * root, std::hypot(kBetweenAngle * root, 0.05 * since.phi));
}

double lengthBetween(const TPose2D& a, const TPose2D& b) { return std::hypot(b.x - a.x, b.y - a.y); }

std::vector<StepVariance> driftAlong(const std::vector<TPose2D>& path, bool hasLines) {
  std::vector<StepVariance> steps(path.size());
  for (size_t i = 1; i < path.size(); ++i) {
    const double length = lengthBetween(path[i - 1], path[i]);
    steps[i] = {square(hasLines ? kDrift : kOpenDrift) * length,
                square(hasLines ? kDriftAngle : kOpenDriftAngle) * length};
  }
  return steps;
}

/// Pairs of path indices at the same part of the map.
std::vector<KnownPair> loopsOf(const std::vector<TPose2D>& path, const std::vector<Revisit>& returning) {
  std::vector<double> distances(path.size());
  for (size_t i = 1; i < path.size(); ++i)
    distances[i] = distances[i - 1] + lengthBetween(path[i - 1], path[i]);
  std::vector<KnownPair> pairs;
  for (const Revisit& revisit : returning) {
    if (revisit.isContradicted() || revisit.update >= path.size()) continue;
    const size_t later = revisit.update;
    if (!pairs.empty() && distances[later] < distances[pairs.back().later] + kLoops) continue;
    double nearest = kNear;
    KnownPair pair{0, later, diagonal(kMatch, kMatchAngle)};
    for (size_t i = 0; distances[i] < distances[later] - kReturn; ++i)
      if (const double distance = std::hypot(path[i].x - path[later].x, path[i].y - path[later].y);
          distance < nearest)
        nearest = distance, pair.earlier = i;
    if (nearest < kNear) pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace

PoseCovariance covarianceOf(const std::vector<WeightedPose>& particles) {
  double highest = -INFINITY, sum = 0;
  for (const WeightedPose& particle : particles) highest = std::max(highest, particle.logWeight);
  // Headings about that of one particle: they do not wrap.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& [pose, logWeight] : particles) {
    const TPose2D& first = particles.front().pose;
    const Eigen::Vector3d off(pose.x - first.x, pose.y - first.y, mrpt::math::wrapToPi(pose.phi - first.phi));
    const double weight = std::exp(logWeight - highest);
    sum += weight, mean += weight * off, squares += weight * off * off.transpose();
  }
  if (sum == 0) return Eigen::Matrix3d::Zero();
  mean /= sum;
  return squares / sum - mean * mean.transpose();
}

PathCovariances::PathCovariances(std::vector<TPose2D> path, std::vector<PoseCovariance> particles,
                                 const std::vector<Revisit>& returning, bool hasLines)
    : path_(std::move(path)),
      particles_(std::move(particles)),
      drift_(path_, driftAlong(path_, hasLines)),
      loops_(loopsOf(path_, returning)) {
  particles_.resize(path_.size(), PoseCovariance::Zero());
}

std::vector<PoseCovariance> PathCovariances::ofPoses() const {
  std::vector<PoseCovariance> all;
  for (size_t i = 0; i < path_.size(); ++i) {
    const PathPoint pose{i, path_[i]};
    all.push_back(particles_[i] + (i > 0 ? inMap({0, path_[0]}, pose) : ofMatch(pose)));
  }
  return all;
}

PoseCovariance PathCovariances::between(const PathPoint& from, const PathPoint& to) const {
  PoseCovariance turn = PoseCovariance::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-from.pose.phi).toRotationMatrix();
  return turn * inMap(from, to) * turn.transpose();
}

PoseCovariance PathCovariances::inMap(const PathPoint& from, const PathPoint& to) const {
  // An error of `from` moves `to` the other way in its frame; that of its heading turns `to` about it.
  PoseCovariance lever = PoseCovariance::Identity();
  lever(0, 2) = from.pose.y - to.pose.y, lever(1, 2) = to.pose.x - from.pose.x;
  return drift_.relaxed(from.update, to.update, loops_) + ofMatch(to) +
         lever * ofMatch(from) * lever.transpose();
}

PoseCovariance PathCovariances::ofMatch(const PathPoint& point) const {
  return diagonal(kMatch, kMatchAngle) + ofMotion(point.pose - path_[point.update]);
}

void writeCovariances(std::ostream& out, const files::Trajectory& trajectory,
                      const std::vector<size_t>& updates, const std::vector<TPose2D>& path,
                      const std::vector<PoseCovariance>& covariances) {
  out << "timestamp,xx,xy,yy,xphi,yphi,phiphi\n";
  for (size_t i = 0; i < trajectory.size(); ++i) {
    PoseCovariance covariance = diagonal(kMatch, kMatchAngle);
    if (!path.empty()) {
      const size_t update = std::clamp<size_t>(updates[i], 1, path.size()) - 1;
      covariance = covariances[update] + ofMotion(trajectory[i].pose - path[update]);
    }
    out << fixedText(trajectory[i].timestamp, 6);
    for (const auto& [row, column] : {std::pair(0, 0), {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}})
      out << ',' << numberText(covariance(row, column), std::chars_format::general, 6);
    out << '\n';
  }
}

}  // namespace hybrid_slam::run
