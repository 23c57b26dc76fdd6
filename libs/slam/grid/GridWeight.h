/// @file GridWeight.h
/// @brief w_grid of Sec. III-D: fit of a scan to a particle's grid.
#pragma once

#include "slam/grid/PenetrationModel.h"

namespace hybrid_slam {

/// Weighs one reading on the grids of all particles by the method of GridWeightOptions.
class GridWeight {
 public:
  GridWeight(const GridWeightOptions& options, double resolution)
      : options_(options), penetration_(options, resolution) {}

  /// The logarithm of w_grid before tempering, at most 0. For the penetration model this is the mean
  /// log-likelihood of a beam; where MRPT's method gives the log-likelihood of the whole scan, it is divided
  /// by the number of beams, so that one exponent serves all.
  /// @param beams  `scans` prepared; used by the penetration model
  /// @param scans  used by MRPT's methods, on a copy of the cells within their reach
  double logWeight(const ScanBeams& beams, const LaserScans& scans, const mrpt::math::TPose2D& robot,
                   const OccupancyGrid& grid) const;

 private:
  GridWeightOptions options_;
  PenetrationModel penetration_;
};

}  // namespace hybrid_slam
