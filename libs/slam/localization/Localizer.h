/// @file Localizer.h
/// @brief Monte Carlo localisation in a fixed map.
#pragma once

#include <tbb/task_arena.h>

#include <deque>
#include <optional>

#include "slam/filter/Filter.h"
#include "slam/filter/ParticleSet.h"
#include "slam/localization/GlobalLocalization.h"

namespace hybrid_slam {

/// The particle filter of HybridFilter in a map that does not change. While the robot's place is unknown,
/// GlobalLocalization replaces the particles: at the beginning if no start is given, and after several
/// successive scans that contradict the map because the robot was carried elsewhere, has left the map, or the
/// surroundings have changed.
class Localizer : public Filter {
 public:
  /// The resolution is that of the map, not `resolution` of [grid].
  /// @param lines  may be empty
  /// @param start  pose of the robot (m, rad; map frame) at the first scan, right within 0.5 m and 15 deg;
  ///               empty: anywhere in the map
  /// @throws InputError for incompatible settings
  Localizer(FilterConfiguration configuration, OccupancyGrid grid, LineDatabase lines,
            std::optional<mrpt::math::TPose2D> start);

  void process(const mrpt::math::TPose2D& odometry, const Scans& scans) override;

  /// Returns whether the robot's place is known. If not, several places are possible, or none fits; the poses
  /// and their spreads then cover all of them.
  bool isLocalized() const { return isTracking_; }
  /// Returns how often the place turned out to be wrong or was lost, also if it was found again at once.
  size_t losses() const { return losses_; }

  size_t updates() const override { return path_.size(); }
  const FilterStep& lastStep() const override { return step_; }
  /// Returns the best estimate at each update, not corrected later.
  std::vector<mrpt::math::TPose2D> bestPath() const override { return path_; }
  mrpt::maps::COccupancyGridMap2D bestGrid() const override;
  std::vector<DatabaseLine> bestLines() const override { return lines_.lines(); }
  std::vector<WeightedPose> particlePoses() const override;
  std::optional<Place> place() const override;

 private:
  void update(const Scans& scans);
  void track(const PreparedScan& scan, bool isRemembered);
  void check(const BeamShares& shares);
  void search(bool isRemembered);
  void trackFromStart(bool isRemembered);
  void startTracking(const mrpt::math::TPose2D& pose);
  void summarise(const mrpt::math::TPose2D& best);

  UpdateInterval interval_;
  int particleCount_;  ///< while tracking
  uint64_t seed_;
  OccupancyGrid grid_;
  LineDatabase lines_;
  std::optional<mrpt::math::TPose2D> start_;  ///< moved by the odometry; until tracking begins there
  ScanPreparation prepare_;
  ParticleSet particles_;
  GlobalLocalization global_;
  RecentScans recent_;
  tbb::task_arena arena_;
  bool isTracking_ = false, hasTracked_ = false;
  size_t losses_ = 0;
  size_t unsupported_ = 0;      ///< successive scans that do not fit the map at the tracked pose
  std::deque<bool> explained_;  ///< for each of the last scans, whether the map explains it at that pose
  mrpt::math::TPose2D odometry_;
  mrpt::math::TPose2D pose_;  ///< best estimate
  std::vector<mrpt::math::TPose2D> path_;
  FilterStep step_;
};

}  // namespace hybrid_slam
