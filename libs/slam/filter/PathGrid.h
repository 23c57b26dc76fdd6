/// @file PathGrid.h
/// @brief The grid of a filter without grids: its scans along its path, for display and results.
#pragma once

#include <vector>

#include "base/LaserScan.h"
#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// A grid that is made of scans when it is asked for.
class PathGrid {
 public:
  explicit PathGrid(const GridOptions& options);

  /// Returns a grid with the scans at the poses of the path (m, rad, map frame).
  /// @param path   as long as `scans`
  const OccupancyGrid& of(const std::vector<mrpt::math::TPose2D>& path, const std::vector<Scans>& scans);

 private:
  GridOptions options_;
  /// The beginning of the last path: unless it has changed, its scans are not inserted again. It excludes the
  /// newest poses, in which another particle's path differs.
  std::vector<mrpt::math::TPose2D> settledPath_;
  OccupancyGrid settled_, whole_;
};

}  // namespace hybrid_slam
