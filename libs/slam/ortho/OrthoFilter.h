/// @file OrthoFilter.h
/// @brief The orthogonal line SLAM behind our filter interface: `--method ortho`.
#pragma once

#include "slam/filter/Filter.h"
#include "slam/filter/FilterOptions.h"
#include "slam/filter/PathGrid.h"
#include "slam/filter/PreparedScan.h"
#include "slam/ortho/OrthoMap.h"

namespace hybrid_slam {

/// OrthoMap with the line extraction, the motion model and the update distances of the configuration. It is
/// deterministic and maps no cells: `bestGrid` inserts the scans along the path.
class OrthoFilter : public Filter {
 public:
  OrthoFilter(const FilterConfiguration& configuration, const OrthoOptions& options);

  void process(const mrpt::math::TPose2D& odometry, const Scans& scans) override;

  size_t updates() const override { return path_.size(); }
  /// Returns the last step. Its `poses` have the mean and the covariance of the pose.
  const FilterStep& lastStep() const override { return step_; }
  /// Returns each pose as estimated at its update.
  std::vector<mrpt::math::TPose2D> bestPath() const override { return path_; }
  mrpt::maps::COccupancyGridMap2D bestGrid() const override;
  std::vector<DatabaseLine> bestLines() const override { return map_.lines(); }
  /// Six poses with the mean and the covariance of the pose.
  std::vector<WeightedPose> particlePoses() const override;

 private:
  UpdateInterval interval_;
  MotionModelOptions motion_;
  double maxRange_;  ///< m
  ScanPreparation prepare_;
  OrthoMap map_;
  mrpt::math::TPose2D odometry_;  ///< since the last update
  std::vector<mrpt::math::TPose2D> path_;
  std::vector<Scans> scans_;  ///< of each update
  FilterStep step_;
  mutable PathGrid pathGrid_;
};

}  // namespace hybrid_slam
