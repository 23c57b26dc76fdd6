/// @file MapMaker.h
/// @brief Builds the map of scans at known poses.
#pragma once

#include <optional>
#include <vector>

#include "base/LaserScan.h"
#include "slam/features/FeatureDatabase.h"
#include "slam/filter/FilterOptions.h"
#include "slam/filter/PreparedScan.h"
#include "slam/grid/OccupancyGrid.h"
#include "slam/lines/LineDatabase.h"

namespace hybrid_slam {

/// The scans of a reading and the robot's pose.
struct PosedScans {
  Scans scans;
  mrpt::math::TPose2D pose;  ///< map frame
  bool isMapped = false;     ///< used in an update: its beams and lines are in the map

  template <class State>
  void visit(State& state) {
    state(scans, pose, isMapped);
  }
};

/// A map made from scans at their poses, or by an earlier run.
struct ScanMap {
  OccupancyGrid grid;
  LineDatabase lines;
  FeatureDatabase features = {};  ///< not in `visit`: a run that continues the map collects new ones

  template <class State>
  void visit(State& state) {
    state(grid, lines);
  }
};

/// Returns the grid of the mapped scans.
/// @param base  map to insert them into; empty: none
OccupancyGrid gridOf(const std::vector<PosedScans>& scans, const GridOptions& options,
                     const std::optional<ScanMap>& base);

/// Builds maps from scans at their poses.
class MapMaker {
 public:
  explicit MapMaker(const FilterConfiguration& configuration);
  /// @param base  map to insert the scans into; default: an empty map
  ScanMap operator()(const std::vector<PosedScans>& scans, const std::optional<ScanMap>& base = {}) const;

 private:
  ScanPreparation prepare_;
  GridOptions grid_;
  LineDatabaseOptions database_;
  AssociationOptions association_;
  FeatureOptions features_;
};

}  // namespace hybrid_slam
