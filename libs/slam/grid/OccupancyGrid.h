/// @file OccupancyGrid.h
/// @brief A particle's map: occupancy log-odds on shared tiles, and scan insertion.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cmath>

#include "base/Options.h"
#include "slam/grid/ScanBeams.h"
#include "slam/grid/TileGrid.h"

namespace hybrid_slam {

/// Section [grid].
struct GridOptions : Options {
  double resolution = 0.05;  ///< m
  double maxRange = 20;      ///< m
  double pHit = 0.6, pMiss = 0.49;
  double pMin = 0.03, pMax = 0.97;
  double wallGap = 1;  ///< m
  void describe(OptionTable& table) override;
};

/// Returns options without wall gaps: a match to a map of a few scans must not slide along filled walls.
GridOptions hitsAlone(GridOptions options);

/// Returns options without wall gaps and with larger update steps: a map of a few scans must show walls and
/// free space as clearly as the map of many.
GridOptions decisive(GridOptions options);

/// An unbounded occupancy grid; copying costs a few pointers (see TileGrid).
class OccupancyGrid {
 public:
  /// Log-odds per unit of a cell's value: MRPT's scale.
  static constexpr double kLogOddsScale = 1.0 / 16;

  /// Occupancy probability of a cell with this value.
  static double probabilityOf(int value) { return 1 / (1 + std::exp(-kLogOddsScale * value)); }
  /// The same backwards, not rounded.
  static double valueOf(double probability) {
    return std::log(probability / (1 - probability)) / kLogOddsScale;
  }

  explicit OccupancyGrid(double resolution = 0.05) : resolution_(resolution) {}

  double resolution() const { return resolution_; }  ///< m
  /// Occupancy probability of a cell; 0.5 if unknown.
  double occupancy(CellIndex cell) const;
  CellIndex cellOf(double x, double y) const;  ///< x, y in m, map frame
  mrpt::math::TPoint2D middle() const;         ///< of the bounding box of the mapped tiles, m, map frame

  /// Map estimation (Sec. III-A, step 4): each cell with a beam end point gets one hit per scan, every other
  /// crossed cell a miss. A hit overrides the misses of its scan, so that neighbouring beams do not erase a
  /// wall seen at a grazing angle.
  ///
  /// With `wallGap`, the cells of a straight wall between the end points of neighbouring beams (see wallGaps)
  /// also get a hit. Without, the next scan fits best where its beams hit the cells of the scans before: that
  /// pattern moves with the robot, so corridors become too short.
  void insert(const ScanBeams& scan, const mrpt::math::TPose2D& robot, const GridOptions& options);

  /// Limits every probability, so that later scans can change it.
  void limit(double pMin, double pMax);

  const TileGrid& tiles() const { return tiles_; }
  TileGrid& tiles() { return tiles_; }
  template <class State>
  void visit(State& state) {
    state(resolution_, tiles_);
    state.check(0.001 <= resolution_ && resolution_ <= 10, "a cell has an impossible size");
  }

 private:
  double resolution_;
  TileGrid tiles_;
};

}  // namespace hybrid_slam
