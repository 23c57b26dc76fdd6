/// @file ScanMatcher.h
/// @brief A scan against a particle's grid: the most likely pose near a predicted one, and how sure it is.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <functional>

#include "base/Options.h"
#include "slam/grid/ScanLikelihood.h"

namespace hybrid_slam {

/// Section [scan_matcher].
struct ScanMatcherOptions : Options {
  double sigma = 0.3;
  int beams = 90;
  int iterations = 20;
  void describe(OptionTable& table) override;
};

/// What is known of the pose beside the scan (odometry, line directions), as a function of the pose.
using Prior = std::function<LogDensity(const mrpt::math::TPose2D&)>;

/// The normal density around `mean` with the given information matrix (inverse covariance), up to a constant.
LogDensity gaussianLogDensity(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& mean,
                              const Eigen::Matrix3d& information);

/// Where a match ended.
struct ScanMatch {
  mrpt::math::TPose2D pose;
  double fit = 0;           ///< mean over the beams of m at their ends, in [0, 1]; 0 without a beam
  double logPosterior = 0;  ///< of the scan and the prior at `pose`, up to a constant
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of scan and prior at `pose`
};

/// Matches the ends of the beams with the occupied cells.
///
/// Gauss-Newton climbs from the predicted pose; how the likelihood bends at the top is the information that
/// the scan holds, which is little along a featureless corridor.
///
/// Basin of convergence, measured in a made room of 8 m x 6 m without a prior, 400 random poses each: all
/// climbs from 5 cm and up to 10 deg away reach the true pose (within 2 cm and 0.5 deg), 98 % of those from
/// 10 cm, 93 % from 15 cm and 87 % from 20 cm (each with 5 deg). Farther away
/// correlativeSearch is the way.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatcherOptions& options);

  /// ln p(scan | pose, grid); scan and grid outlive it.
  ScanLikelihood likelihood(const ScanBeams& scan, const OccupancyGrid& grid) const;

  /// Climbs from `start`.
  ScanMatch match(const ScanBeams& scan, const mrpt::math::TPose2D& start, const OccupancyGrid& grid,
                  const Prior& prior) const;

  /// The same, of a likelihood that is wanted for more.
  ScanMatch match(ScanLikelihood& likelihood, const mrpt::math::TPose2D& start, const Prior& prior) const;

 private:
  ScanMatcherOptions options_;
};

}  // namespace hybrid_slam
