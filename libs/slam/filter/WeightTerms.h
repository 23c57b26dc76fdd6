/// @file WeightTerms.h
/// @brief The terms of a particle's weight besides w_grid.
#pragma once

#include <cmath>
#include <optional>

#include "slam/filter/FeatureLikelihood.h"
#include "slam/filter/LineLikelihood.h"
#include "slam/filter/Particle.h"
#include "slam/filter/PreparedScan.h"
#include "slam/lines/DirectionFrames.h"

namespace hybrid_slam {

/// Lines (Sec. III-D) and features (the paper's future work). A new term is added to `at` for the standard
/// proposal, and to `Density` for the improved one.
class WeightTerms {
 public:
  explicit WeightTerms(const FilterConfiguration& c)
      : useLines_(c.useLines),
        lineWeight_(c.lineWeight),
        lineLikelihood_(c.lineWeight, c.association, c.database.minCount, c.improved),
        features_(c.features) {}

  /// The terms at one pose.
  struct Value {
    LineWeight line;
    double logFeatures = 0;
    double log() const { return std::log(line.value) + logFeatures; }
  };
  /// The terms of a particle at `pose` (map frame).
  Value at(const Particle& particle, const mrpt::math::TPose2D& pose, const PreparedScan& scan) const {
    Value value;
    value.line = lineWeight(particle, pose, scan);
    if (features_.enabled)
      value.logFeatures =
          FeatureLikelihood(scan.features, pose, Eigen::Matrix3d::Zero(), *particle.features, features_)(pose)
              .value;
    return value;
  }

  /// w_line, eq. (9); 1 without lines.
  LineWeight lineWeight(const Particle& particle, const mrpt::math::TPose2D& pose,
                        const PreparedScan& scan) const {
    if (!useLines_) return {};
    return hybrid_slam::lineWeight(
        scan.lines, pose.phi, *comparedLines(*particle.lines, {pose.x, pose.y}, lineWeight_), lineWeight_);
  }

  /// The directions that several lines near the particle share.
  std::vector<DirectionFrame> frames(const Particle& particle) const {
    const mrpt::math::TPose2D pose = particle.path.back();
    return directionFrames(linesNear(*particle.lines, {pose.x, pose.y}, lineWeight_.radius).lines());
  }

  /// ln p(lines | x) + ln p(features | x) as a function of the pose x. Refers to the particle's map.
  class Density {
   public:
    /// @param predicted    where lines and features are associated (m, rad; map frame)
    /// @param uncertainty  covariance of the predicted pose
    Density(const WeightTerms& terms, const Particle& particle, const PreparedScan& scan,
            const mrpt::math::TPose2D& predicted, const Eigen::Matrix3d& uncertainty) {
      if (terms.useLines_) lines_.emplace(scan.lines, predicted, *particle.lines, terms.lineLikelihood_);
      if (terms.features_.enabled)
        features_.emplace(scan.features, predicted, uncertainty, *particle.features, terms.features_);
    }

    LogDensity operator()(const mrpt::math::TPose2D& pose) const {
      LogDensity density;
      if (lines_) density += (*lines_)(pose);
      if (features_) density += (*features_)(pose);
      return density;
    }

   private:
    std::optional<LineLikelihood> lines_;
    std::optional<FeatureLikelihood> features_;
  };

 private:
  bool useLines_;
  LineWeightOptions lineWeight_;
  LineLikelihoodOptions lineLikelihood_;
  FeatureOptions features_;
};

}  // namespace hybrid_slam
