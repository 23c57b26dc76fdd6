/// @file FeatureDatabase.h
/// @brief The corners and arcs of a particle's map.
#pragma once

#include <optional>
#include <vector>

#include "slam/features/FeatureOptions.h"
#include "slam/features/PointFeature.h"

namespace hybrid_slam {

/// A feature of the map, merged from its observations.
struct MapFeature : PointFeature {
  int count = 1;     ///< number of observations, including the first
  int inserted = 0;  ///< update that inserted it

  template <class State>
  void visit(State& state) {
    PointFeature::visit(state);
    state(count, inserted);
    constexpr int kMost = 1'000'000'000;  // far below the greatest int
    state.check(1 <= count && count <= kMost && 0 <= inserted && inserted <= kMost,
                "a feature is impossible");
  }
};

/// Returns the squared Mahalanobis distance between two observations of one feature, or an observation and a
/// feature. Empty if they cannot be the same: kinds differ, directions of corners differ by more than 45 deg,
/// positions by more than 2 m in x or y, or positions or radii by more than three standard deviations. That
/// of a radius includes 10 % of it, by which arcs of few beams are off.
std::optional<double> squaredMatchDistance(const PointFeature& seen, const PointFeature& known);

/// Updates a feature's position and radius by an observation (Kalman). Its direction stays that of the first.
MapFeature merged(const MapFeature& feature, const PointFeature& seen);

/// The features of one particle, in the map frame.
class FeatureDatabase {
 public:
  /// Merges each observation into the feature that it matches best, or inserts it. Every pruneInterval steps,
  /// removes features seen fewer than minCount times, except those younger than pruneInterval steps.
  /// @param seen  map frame; covariance includes the pose error (`withModelError`)
  void update(const std::vector<PointFeature>& seen, const FeatureOptions& options);

  const std::vector<MapFeature>& features() const { return features_; }

  /// Returns the indices of the features that are near enough to match one of those seen, in ascending order.
  std::vector<size_t> candidates(const std::vector<PointFeature>& seen) const;

  /// Returns the closest match among the candidates observed at least `minCount` times, or null.
  const MapFeature* closestMatch(const PointFeature& seen, const std::vector<size_t>& candidates,
                                 int minCount = 1) const;

  template <class State>
  void visit(State& state) {
    state(features_, updates_);
    state.check(0 <= updates_ && updates_ <= 1'000'000'000, "the features have an impossible age");
  }

 private:
  std::vector<MapFeature> features_;
  int updates_ = 0;
};

}  // namespace hybrid_slam
