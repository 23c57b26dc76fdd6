/// @file RecentMap.h
/// @brief The newest scans of a path: what they show of the surroundings is free of the path's drift.
#pragma once

#include <deque>

#include "slam/filter/Path.h"
#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Distinguishes two reasons why a scan contradicts the map: the robot is not where it is believed to be, or
/// it returns to a place from which its path has drifted. In the second case the scan still agrees with what
/// the robot has just seen.
class RecentMap {
 public:
  static constexpr size_t kScans = 40;  ///< the newest ones; older ones are forgotten

  /// @param grid  of the particles
  explicit RecentMap(const GridOptions& grid) : grid_(grid) {}
  /// Adds the scan of an update.
  void add(const ScanBeams& scan);
  void clear() { scans_.clear(); }
  /// A map of these scans.
  /// @param path  ends at the newest of them (map frame)
  /// @param skip  newest scans that are left out
  OccupancyGrid map(const Path& path, size_t skip) const;

  template <class State>
  void visit(State& state) {
    state(scans_);
    for (const ScanBeams& scan : scans_)
      state.check(scan.areWithin(grid_.maxRange), "a recent scan reaches beyond the map's range");
  }

 private:
  GridOptions grid_;
  std::deque<ScanBeams> scans_;  ///< newest last
};

}  // namespace hybrid_slam
