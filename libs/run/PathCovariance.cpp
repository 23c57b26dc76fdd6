#include "run/PathCovariance.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Numbers.h"
#include "base/PoseDistance.h"
#include "base/PoseOffset.h"
#include "base/PoseRotation.h"
#include "slam/loops/PathDrift.h"

namespace hybrid_slam::run {

using mrpt::math::TPose2D;

namespace {

constexpr double square(double x) { return x * x; }

// Tuned on simulated logs: doc/verdict.md.
constexpr double kMatch = 0.01, kMatchAngle = mrpt::DEG2RAD(0.09);  // of a scan match
constexpr PathDrift kRelaxed{0.004, mrpt::DEG2RAD(0.008)}, kRelaxedWithoutLines{0.005, mrpt::DEG2RAD(0.038)};
constexpr double kBetween = 0.02, kBetweenAngle = mrpt::DEG2RAD(1.0);  // per sqrt(m), odometry alone
constexpr double kLoops = 4, kNear = 3;                                // m

Eigen::Matrix3d diagonal(double position, double heading) {
  return Eigen::Vector3d(square(position), square(position), square(heading)).asDiagonal();
}

/// The motion since an update.
Eigen::Matrix3d ofMotion(const TPose2D& since) {
  const double root = std::sqrt(since.norm());
  return diagonal(kBetween * root, std::hypot(kBetweenAngle * root, 0.05 * since.phi));
}

std::vector<StepVariance> driftAlong(const std::vector<TPose2D>& path, const PathDrift& drift) {
  std::vector<StepVariance> steps(path.size());
  for (size_t i = 1; i < path.size(); ++i) {
    const double length = distanceBetween(path[i - 1], path[i]);
    steps[i] = {square(drift.position) * length, square(drift.heading) * length};
  }
  return steps;
}

/// Pairs of path indices at the same part of the map.
std::vector<KnownPair> loopsOf(const std::vector<TPose2D>& path, const std::vector<Revisit>& returning) {
  const std::vector<double> distances = lengthsAlong(path);
  // At most a thousand, so that a long path does not take a time in proportion to its square.
  const double apart = std::max(kLoops, path.empty() ? 0 : distances.back() / 1000);
  std::vector<KnownPair> pairs;
  for (const Revisit& revisit : returning) {
    if (revisit.isContradicted() || revisit.update >= path.size()) continue;
    const size_t later = revisit.update;
    if (!pairs.empty() && distances[later] < distances[pairs.back().later] + apart) continue;
    double nearest = kNear;
    KnownPair pair{0, later, diagonal(kMatch, kMatchAngle), true};
    for (size_t i = 0; distances[i] < distances[later] - RevisitCheck::kReturn; ++i)
      if (const double distance = distanceBetween(path[i], path[later]); distance < nearest)
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
    const Eigen::Vector3d off = offsetOf(pose, particles.front().pose);
    const double weight = std::exp(logWeight - highest);
    sum += weight, mean += weight * off, squares += weight * off * off.transpose();
  }
  if (sum == 0) return Eigen::Matrix3d::Zero();
  mean /= sum;
  return squares / sum - mean * mean.transpose();
}

PathCovariances::PathCovariances(std::vector<TPose2D> path, std::vector<PoseCovariance> particles,
                                 const std::vector<Revisit>& returning, bool hasLines, bool isRelaxed)
    : path_(std::move(path)),
      particles_(std::move(particles)),
      isRelaxed_(isRelaxed),
      drift_(path_, driftAlong(path_, isRelaxed  ? hasLines ? kRelaxed : kRelaxedWithoutLines
                                      : hasLines ? kDriftWithLines
                                                 : kDriftWithoutLines)),
      loops_(loopsOf(path_, returning)) {
  particles_.resize(path_.size(), PoseCovariance::Zero());
}

std::vector<PoseCovariance> PathCovariances::ofPoses() const {
  std::vector<PoseCovariance> all;
  for (size_t i = 0; i < path_.size(); ++i) {
    const PathPoint pose{i, path_[i]};
    all.push_back(particles_[i] +
                  (isRelaxed_ && i > 0 ? inMap({0, path_[0]}, pose) : driftBetween(0, i) + ofMatch(pose)));
  }
  return all;
}

PoseCovariance PathCovariances::between(const PathPoint& from, const PathPoint& to) const {
  return rotated(inMap(from, to), -from.pose.phi);
}

PoseCovariance PathCovariances::inMap(const PathPoint& from, const PathPoint& to) const {
  // An error of `from` moves `to` the other way in its frame; that of its heading turns `to` about it.
  PoseCovariance lever = PoseCovariance::Identity();
  lever(0, 2) = from.pose.y - to.pose.y, lever(1, 2) = to.pose.x - from.pose.x;
  return driftBetween(from.update, to.update) + ofMatch(to) + lever * ofMatch(from) * lever.transpose();
}

PoseCovariance PathCovariances::driftBetween(size_t from, size_t to) const {
  return isRelaxed_ ? drift_.relaxed(from, to, loops_) : drift_.between(from, to, loops_);
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
