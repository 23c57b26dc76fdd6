/// @file WallIndex.h
/// @brief A uniform grid over the walls of a plan, so that a ray tests only nearby walls.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

#include "study/simulation/Wall.h"

namespace hybrid_slam::simulation {

/// Each cell lists the walls that may touch it. A ray visits the cells in order of crossing (Amanatides & Woo
/// 1987) and stops at the first hit inside the current cell.
class WallIndex {
 public:
  explicit WallIndex(std::vector<Wall> walls);

  const std::vector<Wall>& walls() const { return walls_; }
  const mrpt::math::TPoint2D& low() const { return low_; }    ///< m, lower left corner of all walls
  const mrpt::math::TPoint2D& high() const { return high_; }  ///< m, upper right corner

  /// Returns the distance (m) to the first wall along the ray; infinity without a hit within maxRange.
  double rayDistance(const mrpt::math::TPoint2D& origin, const mrpt::math::TPoint2D& direction,
                     double maxRange) const;
  /// Returns the distance (m) to the nearest wall; infinity without walls.
  double nearestDistance(const mrpt::math::TPoint2D& p) const;

 private:
  size_t cellNumber(int column, int row) const { return static_cast<size_t>(row) * columns_ + column; }
  int columnOf(double x) const;
  int rowOf(double y) const;
  bool mayTouch(const Wall& wall, int column, int row) const;

  std::vector<Wall> walls_;
  mrpt::math::TPoint2D low_, high_;
  double cellSize_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> cells_;  ///< wall numbers
};

}  // namespace hybrid_slam::simulation
