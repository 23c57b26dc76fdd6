/// @file ScanMatcher.h
/// @brief Scan matching on a particle's grid: the most likely pose near a prediction, and its information
/// matrix.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <functional>
#include <optional>

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

/// Prior on the pose (odometry, line directions), as a function of the pose.
using Prior = std::function<LogDensity(const mrpt::math::TPose2D&)>;
/// All poses are equally likely.
inline LogDensity noPrior(const mrpt::math::TPose2D&) { return {}; }

/// The normal density around `mean` with the given information matrix (inverse covariance), up to a constant.
LogDensity gaussianLogDensity(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& mean,
                              const Eigen::Matrix3d& information);
/// A normal prior around `expected` with these standard deviations in x, y (m) and heading (rad).
Prior normalPrior(const mrpt::math::TPose2D& expected, const Eigen::Vector3d& deviations);

/// Information of a scan on its pose (x, y, phi; map axes; 1/m^2, 1/(m rad), 1/rad^2): minus the second
/// derivative of the log-likelihood, negative part removed, from gradients 1.5 cells (3/4 deg) to either
/// side. It is small along a featureless corridor. The Gauss-Newton matrix would count the roughness of a
/// sparsely hit wall as information along it, and is zero on the ridge of a wall.
Eigen::Matrix3d scanInformation(ScanLikelihood& likelihood, const mrpt::math::TPose2D& pose);

/// Smallest over largest eigenvalue of the information on the position, heading unknown: in [0, 1], about 0
/// along a featureless corridor, and 0 without beams.
double degeneracy(const Eigen::Matrix3d& information);

/// Result of a match.
struct ScanMatch {
  mrpt::math::TPose2D pose;
  double fit = 0;           ///< mean of m at the beam end points, in [0, 1]; 0 without beams
  double logPosterior = 0;  ///< of the scan and the prior at `pose`, up to a constant
};

/// Returns the pose up to half a metre ahead, behind, left or right of `pose` where the scan fits best; empty
/// if that is the next cell or `pose` itself, where a match leads anyway.
std::optional<mrpt::math::TPose2D> bestNear(ScanLikelihood& likelihood, const mrpt::math::TPose2D& pose);

/// Matches the beam end points to the occupied cells by Gauss-Newton steps from the predicted pose.
///
/// Basin of convergence, measured in a simulated room of 8 m x 6 m without a prior, 400 random poses each:
/// all starts 5 cm and up to 10 deg away reach the true pose (within 2 cm and 0.5 deg), 98 % from 10 cm, 93 %
/// from 15 cm and 87 % from 20 cm (each with 5 deg). For larger distances use correlativeSearch.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatcherOptions& options);

  /// ln p(scan | pose, grid); scan and grid must outlive it.
  ScanLikelihood likelihood(const ScanBeams& scan, const OccupancyGrid& grid) const;

  /// Optimises from `start`.
  ScanMatch match(const ScanBeams& scan, const mrpt::math::TPose2D& start, const OccupancyGrid& grid,
                  const Prior& prior) const;

  /// Optimises a likelihood that the caller keeps using, so that its cached cells are reused.
  ScanMatch match(ScanLikelihood& likelihood, const mrpt::math::TPose2D& start, const Prior& prior) const;

 private:
  ScanMatcherOptions options_;
};

}  // namespace hybrid_slam
