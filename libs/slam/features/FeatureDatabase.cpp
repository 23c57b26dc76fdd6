#include "slam/features/FeatureDatabase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybrid_slam {

namespace {

constexpr double kGate = 9;           // squared standard deviations
constexpr double kFarthest = 2;       // m: no two observations of a feature are farther apart
constexpr double kRadiusError = 0.1;  // share of the radius that its variance does not cover

Eigen::Vector2d innovation(const PointFeature& seen, const PointFeature& known) {
  return {seen.position.x - known.position.x, seen.position.y - known.position.y};
}

}  // namespace

std::optional<double> squaredMatchDistance(const PointFeature& seen, const PointFeature& known) {
  if (seen.kind != known.kind) return std::nullopt;
  const Eigen::Vector2d off = innovation(seen, known);
  if (std::abs(off.x()) > kFarthest || std::abs(off.y()) > kFarthest) return std::nullopt;
  // A bound of the last check, by the traces instead of the largest eigenvalue: most pairs end here.
  if (off.squaredNorm() > kGate * (seen.covariance.trace() + known.covariance.trace())) return std::nullopt;
  if (!seen.isArc()) {
    if (std::abs(std::remainder(seen.direction - known.direction, 2 * M_PI)) > M_PI / 4) return std::nullopt;
  } else {
    const double error = kRadiusError * known.radius;
    if (std::pow(seen.radius - known.radius, 2) >
        kGate * (seen.radiusVariance + known.radiusVariance + error * error))
      return std::nullopt;
  }
  const double squares = off.dot((seen.covariance + known.covariance).inverse() * off);
  if (!(squares <= kGate)) return std::nullopt;
  return squares;
}

MapFeature merged(const MapFeature& feature, const PointFeature& seen) {
  MapFeature result = feature;
  const Eigen::Matrix2d gain = feature.covariance * (feature.covariance + seen.covariance).inverse();
  const Eigen::Vector2d by = gain * innovation(seen, feature);
  result.position += mrpt::math::TPoint2D(by.x(), by.y());
  // Joseph's form stays symmetric and positive definite.
  const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - gain;
  result.covariance =
      rest * feature.covariance * rest.transpose() + gain * seen.covariance * gain.transpose();
  result.covariance(1, 0) = result.covariance(0, 1);  // rounding
  if (feature.radiusVariance + seen.radiusVariance > 0) {
    const double share = feature.radiusVariance / (feature.radiusVariance + seen.radiusVariance);
    result.radius += share * (seen.radius - feature.radius);
    result.radiusVariance *= 1 - share;
  }
  ++result.count;
  return result;
}

void FeatureDatabase::update(const std::vector<PointFeature>& seen, const FeatureOptions& options) {
  ++updates_;
  std::vector<size_t> near = candidates(seen);
  for (const PointFeature& feature : seen) {
    if (const MapFeature* match = closestMatch(feature, near)) {
      features_[static_cast<size_t>(match - features_.data())] = merged(*match, feature);
    } else {
      near.push_back(features_.size());
      features_.push_back({feature, 1, updates_});
    }
  }
  if (updates_ % options.pruneInterval != 0) return;
  const auto isHopeless = [&](const MapFeature& feature) {
    return feature.count < options.minCount && updates_ - feature.inserted >= options.pruneInterval;
  };
  features_.erase(std::remove_if(features_.begin(), features_.end(), isHopeless), features_.end());
}

// The map is searched once for a scan, not once for each of its features.
std::vector<size_t> FeatureDatabase::candidates(const std::vector<PointFeature>& seen) const {
  std::vector<size_t> near;
  if (seen.empty()) return near;
  mrpt::math::TPoint2D least = seen[0].position, most = least;
  for (const PointFeature& feature : seen) {
    least = {std::min(least.x, feature.position.x), std::min(least.y, feature.position.y)};
    most = {std::max(most.x, feature.position.x), std::max(most.y, feature.position.y)};
  }
  constexpr double kMargin = kFarthest + 1e-6;  // rounding
  for (size_t i = 0; i < features_.size(); ++i) {
    const mrpt::math::TPoint2D& at = features_[i].position;
    if (least.x - kMargin <= at.x && at.x <= most.x + kMargin && least.y - kMargin <= at.y &&
        at.y <= most.y + kMargin)
      near.push_back(i);
  }
  return near;
}

const MapFeature* FeatureDatabase::closestMatch(const PointFeature& seen,
                                                const std::vector<size_t>& candidates, int minCount) const {
  const MapFeature* closest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const size_t i : candidates) {
    const MapFeature& feature = features_[i];
    if (feature.count < minCount) continue;
    const auto squares = squaredMatchDistance(seen, feature);
    if (squares && *squares < least) {
      least = *squares;
      closest = &feature;
    }
  }
  return closest;
}

}  // namespace hybrid_slam
