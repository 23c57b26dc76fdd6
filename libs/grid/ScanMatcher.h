/// @file ScanMatcher.h
/// @brief A scan against a particle's grid: the most likely pose near a predicted one, and how sure it is.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <array>
#include <functional>

#include "base/Options.h"
#include "grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Section [scan_matcher].
struct ScanMatcherOptions : Options {
  double sigma = 0.5;
  int beams = 0;
  int iterations = 20;
  void describe(OptionTable& table) override;
};

/// ln of a density of the pose (x, y, phi), with the gradient and the (negative, at least semi-definite)
/// second derivative of its local quadratic form.
struct LogDensity {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< minus the second derivative

  LogDensity& operator+=(const LogDensity& other) {
    value += other.value, gradient += other.gradient, information += other.information;
    return *this;
  }
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
/// The map is m(x, y) = max(0, 2 p - 1), p the occupancy, smoothed by a cubic B-spline over the cells:
/// nothing at unknown and free cells, twice continuously differentiable, blurred by 0.58 cells. A beam that
/// ends at (x, y) has the residual 1 - m, and a scan the log-likelihood - sum (1 - m)^2 / (2 sigma^2), as of
/// so many measurements with the deviation sigma. Gauss-Newton climbs from the predicted pose; how the
/// likelihood bends at the top is the information that the scan holds, which is little along a featureless
/// corridor.
///
/// Basin of convergence, measured in a made room of 8 m x 6 m without a prior, 400 random poses each: all
/// climbs from 5 cm and up to 10 deg away reach the true pose (within 2 cm and 0.5 deg), 98 % of those from
/// 10 cm, 92 % from 15 cm and 87 % from 20 cm (each with 5 deg). Farther away
/// correlativeSearch is the way.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatcherOptions& options);

  /// ln p(scan | pose, grid), up to a constant.
  LogDensity logLikelihood(const ScanBeams& scan, const mrpt::math::TPose2D& pose,
                           const OccupancyGrid& grid) const;
  /// The same, the value alone.
  double logLikelihoodValue(const ScanBeams& scan, const mrpt::math::TPose2D& pose,
                            const OccupancyGrid& grid) const;

  /// Climbs from `start`.
  ScanMatch match(const ScanBeams& scan, const mrpt::math::TPose2D& start, const OccupancyGrid& grid,
                  const Prior& prior) const;

 private:
  /// Minus the second derivative of ln p(scan | pose, grid), without its negative part: differences of the
  /// gradient 1.5 cells (3/4 deg) to either side. The sum of squared slopes that Gauss-Newton climbs by takes
  /// the roughness of a sparsely hit wall for information along it, and has none on the ridge of a wall.
  Eigen::Matrix3d curvature(const ScanBeams& scan, const mrpt::math::TPose2D& pose,
                            const OccupancyGrid& grid) const;

  ScanMatcherOptions options_;
  std::array<double, 256> occupied_;  ///< m of a cell by its value, as an unsigned byte
};

}  // namespace hybrid_slam
