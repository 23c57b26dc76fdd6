/// @file GlobalSearch.h
/// @brief Searches the whole map for the places where a scan may have been taken.
#pragma once

#include <vector>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Agreement of a scan's beams with a map, as shares in [0, 1]; 0 without beams. Beams through unknown cells
/// count in neither share.
struct BeamShares {
  double explained = 0;     ///< end at a wall and pass through none
  double contradicted = 0;  ///< end where the map is free, or pass through a wall
};
/// Compares a scan at a pose (map frame) with the map.
BeamShares beamShares(const ScanBeams& scan, const mrpt::math::TPose2D& robot, const OccupancyGrid& grid);

/// Searches an unchanging map for a scan. The constructor costs a pass over the map.
class GlobalSearch {
 public:
  /// @param around  centre of the search (m, map frame): cells within 500 m are searched
  GlobalSearch(const OccupancyGrid& grid, const mrpt::math::TPoint2D& around);

  /// A pose where the scan may have been taken.
  struct Place {
    mrpt::math::TPose2D pose;  ///< map frame
    double score;              ///< share of the beams that end at walls, those near a wall count half
  };
  /// The poses at which most beams end at walls, best first, on a lattice of about 0.2 m (a whole number of
  /// cells) and 2 deg over the free cells of the map; at most one within 0.5 m and 10 deg. A scan match
  /// should refine them.
  /// @param headings  search only within 6 deg of these (rad); empty: all headings
  /// @param count     maximum number of poses
  /// @param leastScore  of a place, above 0
  std::vector<Place> operator()(const ScanBeams& scan, const std::vector<double>& headings, size_t count,
                                double leastScore = 0.5) const;

  /// Free places (m, map frame), at most one in a square of `spacing` (m).
  std::vector<mrpt::math::TPoint2D> freePlaces(double spacing) const;

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }
  /// 2: wall in the cell of `size_`; 1: wall in a neighbour; 0: neither, or outside the map.
  int wall(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ ? wall_[index(x, y)] : 0;
  }
  /// Highest value of `wall` in the kBlock x kBlock cells from (x, y) on.
  int highest(int x, int y) const {
    x += kBlock, y += kBlock;
    return x >= 0 && y >= 0 && x < width_ + kBlock && y < height_ + kBlock
               ? highest_[static_cast<size_t>(y) * static_cast<size_t>(width_ + kBlock) +
                          static_cast<size_t>(x)]
               : 0;
  }
  mrpt::math::TPoint2D centre(const CellIndex& cell) const {
    return {(min_.x + cell.x + 0.5) * size_, (min_.y + cell.y + 0.5) * size_};
  }

  static constexpr int kBlock = 4;
  double size_;  ///< m
  CellIndex min_{0, 0};
  int width_ = 0, height_ = 0;
  std::vector<char> wall_, highest_;
  std::vector<CellIndex> free_;  ///< row by row
};

}  // namespace hybrid_slam
