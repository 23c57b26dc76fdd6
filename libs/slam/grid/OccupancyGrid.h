/// @file OccupancyGrid.h
/// @brief The particle's map: occupancy log-odds on shared tiles, and scan insertion.
#pragma once

#include <mrpt/math/TPose2D.h>

#include "base/Options.h"
#include "slam/grid/ScanBeams.h"
#include "slam/grid/TileGrid.h"

namespace hybrid_slam {

/// Section [grid].
struct GridOptions : Options {
  double resolution = 0.05;
  double maxRange = 20;
  double pHit = 0.6, pMiss = 0.49;
  double pMin = 0.03, pMax = 0.97;
  void describe(OptionTable& table) override;
};

/// An occupancy grid of unbounded extent; copying it costs a few pointers (see TileGrid).
class OccupancyGrid {
 public:
  /// Log-odds per unit of a cell's value: MRPT's scale.
  static constexpr double kLogOddsScale = 1.0 / 16;

  explicit OccupancyGrid(double resolution = 0.05) : resolution_(resolution) {}

  double resolution() const { return resolution_; }  ///< m
  /// Probability that a cell is occupied; 0.5 where nothing is known.
  double occupancy(CellIndex cell) const;
  CellIndex cellOf(double x, double y) const;  ///< x, y in m, map frame

  /// Map estimation (Sec. III-A, step 4): each cell that a beam ends in is hit once a scan, every other cell
  /// that a beam crosses is missed; a hit outweighs the misses of its own scan, so that a wall seen at a
  /// grazing angle is not wiped out by the neighbouring beams.
  void insert(const ScanBeams& scan, const mrpt::math::TPose2D& robot, const GridOptions& options);

  const TileGrid& tiles() const { return tiles_; }
  TileGrid& tiles() { return tiles_; }

 private:
  double resolution_;
  TileGrid tiles_;
};

}  // namespace hybrid_slam
