/// @file HybridFilter.h
/// @brief The paper's filter, Fig. 1: odometry and scans in, weighted particles with maps out.
#pragma once

#include "slam/filter/Filter.h"
#include "slam/filter/FilterOptions.h"
#include "slam/filter/MapMaker.h"
#include "slam/filter/ParticleSet.h"
#include "slam/filter/PathGrid.h"
#include "slam/loops/LoopCloser.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam {

class StateReader;
class StateWriter;

/// The filter with grids and lines. It updates the particles in `[particle_filter] threads`.
class HybridFilter : public Filter {
 public:
  /// @throws InputError for incompatible settings
  explicit HybridFilter(const FilterConfiguration& configuration);

  void process(const mrpt::math::TPose2D& odometry, const Scans& scans) override;

  size_t updates() const override { return updates_; }
  const FilterStep& lastStep() const override { return particles_.lastStep(); }
  /// Returns one pose for each update.
  std::vector<mrpt::math::TPose2D> bestPath() const override;
  mrpt::maps::COccupancyGridMap2D bestGrid() const override;
  std::vector<DatabaseLine> bestLines() const override;
  std::vector<WeightedPose> particlePoses() const override { return particles_.poses(); }
  /// The odometry since the last update.
  const mrpt::math::TPose2D& odometry() const { return odometry_; }
  /// Map of the best particle. Without grids, its cells are made from the scans along its path.
  ScanMap bestMap() const { return {bestOccupancy(), *particles_.best().lines, *particles_.best().features}; }

  /// Keeps the scans until `joinMap`, `expectNoMap` or longer.
  void expectMap() { remembersScans_ = true; }
  /// Keeps the scans only if the settings need them (FilterConfiguration::keepsScans).
  void expectNoMap();
  /// Compares the scans of the last 50 m of path with a map that the robot may be in. Call it after
  /// `expectMap`.
  /// @param map   with cells of RevisitCheck::kResolution
  /// @param pose  current pose of the robot (m, rad), in that map
  std::vector<Revisit> comparedWith(const OccupancyGrid& map, const mrpt::math::TPose2D& pose) const;
  /// Joins the map so far to that of an earlier run, in its frame. Later loop closures do not change that
  /// map.
  /// @param pose  current pose of the robot (m, rad), in that map; path and scans so far are transformed
  /// accordingly
  /// @returns the angle (rad) by which they turned
  double joinMap(const ScanMap& map, const mrpt::math::TPose2D& pose);
  /// The map of `joinMap`.
  const std::optional<ScanMap>& base() const { return base_; }
  const OccupancyGrid* earlierMap() const override { return base_ ? &base_->grid : nullptr; }

  /// The scans of each update, if they are kept; else empty.
  const std::vector<Scans>& updateScans() const { return updateScans_; }
  /// Returns whether the map consists of these scans only.
  bool isMapOfUpdates() const { return !base_ && known_.empty() && updateScans_.size() == updates_; }

  /// @name The whole state (base/State.h). A filter that loads it gives the same bytes as the saved one.
  /// @{
  void save(StateWriter& out);
  /// @throws StateError; the filter is unusable then
  void load(StateReader& in);
  /// @}

 protected:
  /// Discards the maps and places all particles at the origin.
  void reset();
  /// Puts scans taken at a known pose into every particle's map, before the first update.
  void insertAt(const mrpt::math::TPose2D& pose, const Scans& scans);
  /// All particles continue from `start`, with empty paths.
  void startPathAt(const mrpt::math::TPose2D& start) { particles_.startPathAt(start); }

 private:
  template <class State>
  void visit(State& state);
  void update(const Scans& scans);
  const OccupancyGrid& bestOccupancy() const;
  void closeLoops(const PreparedScan& scan);
  void continueFrom(const std::vector<mrpt::math::TPose2D>& path);
  /// Frame of the map so far in another map, where the robot is at `pose`.
  mrpt::math::TPose2D frameIn(const mrpt::math::TPose2D& pose) const;

  UpdateInterval interval_;
  bool useGrid_, closesLoops_, keepsScans_;
  double resolution_, maxRange_;  ///< m, of the grids
  ScanPreparation prepare_;
  MapMaker makeMap_;
  ParticleSet particles_;
  mrpt::math::TPose2D odometry_;
  size_t updates_ = 0;
  bool hasMap_ = false, remembersScans_;
  LoopCloser loopCloser_;
  std::optional<ScanMap> base_;     ///< of an earlier run
  std::vector<PosedScans> known_;   ///< in the map before the first update
  std::vector<Scans> updateScans_;  ///< if remembersScans_
  mutable PathGrid pathGrid_;       ///< of the best path, without grids
};

}  // namespace hybrid_slam
