/// @file ScanLikelihood.h
/// @brief Likelihood of a scan on a particle's grid, as a function of the pose.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <array>
#include <vector>

#include "slam/grid/CubicSpline.h"
#include "slam/grid/LogDensity.h"
#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// ln p(scan | pose, grid), up to a constant, at nearby poses: the cells around a beam's end point are cached
/// until it moves to another cell.
///
/// The map is m(x, y) = max(0, 2 p - 1), p the occupancy, smoothed by a cubic B-spline over the cells:
/// zero at unknown and free cells, twice continuously differentiable, blurred by 0.58 cells. A beam that ends
/// at (x, y) has the residual 1 - m, and the scan the log-likelihood - sum (1 - m)^2 / (2 sigma^2).
class ScanLikelihood {
 public:
  /// Scan and grid must outlive it.
  ScanLikelihood(const ScanBeams& scan, const OccupancyGrid& grid, double sigma);

  LogDensity operator()(const mrpt::math::TPose2D& pose);
  /// Returns the gradient alone.
  Eigen::Vector3d gradient(const mrpt::math::TPose2D& pose);
  /// Returns the log-likelihood without its derivatives.
  double value(const mrpt::math::TPose2D& pose);
  /// Mean of m at the beam end points, in [0, 1]; 0 without beams.
  double fit(const mrpt::math::TPose2D& pose);
  double resolution() const { return resolution_; }  ///< of the grid, m

 private:
  /// m of the 4 x 4 cells starting at (x, y), row by row.
  struct Patch {
    std::array<Float4, 4> m;
    int x, y;
    bool isRead = false, isEmpty = true;
  };
  const Patch& patchAt(size_t beam, int x, int y);
  void read(Patch& patch);
  template <bool kWithSlope, class Visit>
  void forEachEnd(const mrpt::math::TPose2D& pose, const Visit& visit);
  template <class Visit>
  void forEachResidual(const mrpt::math::TPose2D& pose, const Visit& visit);

  const ScanBeams& scan_;
  double resolution_, perCell_, weight_;
  TileReader cells_;
  std::vector<Patch> patches_;  ///< one per beam
};

}  // namespace hybrid_slam
