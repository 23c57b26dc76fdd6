#include "slam/filter/FeatureLikelihood.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

/// Derivative of a point seen at `at` (map frame) with respect to the robot's pose.
Eigen::Matrix<double, 2, 3> derivative(const TPoint2D& at, const TPose2D& pose) {
  Eigen::Matrix<double, 2, 3> byPose;
  byPose << 1, 0, pose.y - at.y, 0, 1, at.x - pose.x;
  return byPose;
}

}  // namespace

FeatureLikelihood::FeatureLikelihood(const std::vector<PointFeature>& seen, const TPose2D& predicted,
                                     const Eigen::Matrix3d& uncertainty, const FeatureDatabase& database,
                                     const FeatureOptions& options)
    : mostSquares_(-2 * std::log(options.floor)) {
  const auto& known = database.features();
  const auto isUsed = [&](const MapFeature& feature) { return feature.count >= options.minCount; };
  if (seen.empty() || std::none_of(known.begin(), known.end(), isUsed)) return;
  share_ = 1 / std::sqrt(static_cast<double>(seen.size()));
  std::vector<PointFeature> all;
  for (const PointFeature& feature : seen) all.push_back(transformed(feature, predicted));
  const std::vector<size_t> candidates = database.candidates(all);
  for (size_t i = 0; i < seen.size(); ++i) {
    PointFeature& there = all[i];
    const Eigen::Matrix2d covariance = there.covariance;
    const auto byPose = derivative(there.position, predicted);
    there.covariance += byPose * uncertainty * byPose.transpose();
    if (const MapFeature* match = database.closestMatch(there, candidates, options.minCount))
      matches_.push_back({seen[i].position, match->position, (covariance + match->covariance).inverse()});
    else
      unmatched_ -= 0.5 * share_ * mostSquares_;
  }
}

LogDensity FeatureLikelihood::operator()(const TPose2D& pose) const {
  LogDensity density;
  density.value = unmatched_;
  for (const Match& match : matches_) {
    const TPoint2D at = pose.composePoint(match.seen);
    const Eigen::Vector2d off(at.x - match.known.x, at.y - match.known.y);
    const Eigen::Vector2d weighted = match.information * off;
    const double squares = off.dot(weighted);
    density.value -= 0.5 * share_ * std::min(squares, mostSquares_);
    if (squares > mostSquares_) continue;
    const auto byPose = derivative(at, pose);
    density.gradient -= share_ * byPose.transpose() * weighted;
    density.information += share_ * byPose.transpose() * match.information * byPose;
  }
  return density;
}

}  // namespace hybrid_slam
