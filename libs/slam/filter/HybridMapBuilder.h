/// @file HybridMapBuilder.h
/// @brief The paper's filter (Fig. 1) behind the same face as MRPT's CMetricMapBuilderRBPF.
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/slam/CMetricMapBuilder.h>

#include "slam/filter/FilterOptions.h"
#include "slam/filter/FilterView.h"
#include "slam/filter/ParticleSet.h"

namespace hybrid_slam {

class HybridMapBuilder : public mrpt::slam::CMetricMapBuilder, public FilterView {
 public:
  explicit HybridMapBuilder(const FilterConfiguration& configuration);

  /// Starts anew, at x0 if it is given; a map of earlier scans is put into every particle, and then the start
  /// is its last pose unless x0 says otherwise.
  void initialize(const mrpt::maps::CSimpleMap& initialMap = mrpt::maps::CSimpleMap(),
                  const mrpt::poses::CPosePDF* x0 = nullptr) override;

  /// One step of Fig. 1. The odometry is gathered until the robot has moved or turned far enough, then the
  /// filter runs with the first 2D scan of `observations`.
  /// @throws InputError if the action holds no odometry
  void processActionObservation(mrpt::obs::CActionCollection& action,
                                mrpt::obs::CSensoryFrame& observations) override;

  /// The weighted particles, carried on by the odometry since the last update.
  mrpt::poses::CPose3DPDF::Ptr getCurrentPoseEstimation() const override;
  /// The map it was initialized with, and the scans that made the filter run at the best particle's poses,
  /// unless they are not remembered.
  void getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& map) const override;
  /// The best particle's grid; valid until the next call.
  const mrpt::maps::CMultiMetricMap* getCurrentlyBuiltMetricMap() const override;
  unsigned int getCurrentlyBuiltMapSize() override {
    return static_cast<unsigned int>(initialMap_.size() + scans_.size());
  }
  void saveCurrentEstimationToImage(const std::string& file, bool formatEmfBmp = true) override;
  /// The best particle's path, one pose for each update.
  void getCurrentMostLikelyPath(std::deque<mrpt::math::TPose3D>& path) const;

  /// Whether the scans of the updates from now on are kept for getCurrentlyBuiltMap (on by default); memory
  /// then grows with the log.
  void rememberScans(bool remember) { remembersScans_ = remember; }

  size_t updates() const override { return updates_; }
  const FilterStep& lastStep() const override { return particles_.lastStep(); }
  std::vector<mrpt::math::TPose2D> bestPath() const override;
  mrpt::maps::COccupancyGridMap2D bestGrid() const override;
  std::vector<DatabaseLine> bestLines() const override;
  std::vector<WeightedPose> particlePoses() const override { return particles_.poses(); }

 private:
  void update(const mrpt::obs::CObservation2DRangeScan& scan, mrpt::obs::CSensoryFrame& observations);

  FilterConfiguration configuration_;
  ScanPreparation prepare_;
  ParticleSet particles_;
  mrpt::bayes::CParticleFilter particleFilter_;

  mrpt::math::TPose2D odometry_;  ///< since the last update
  size_t updates_ = 0;
  bool hasMap_ = false;
  bool remembersScans_ = true;
  mrpt::maps::CSimpleMap initialMap_;
  std::vector<std::pair<size_t, mrpt::obs::CSensoryFrame::Ptr>> scans_;  ///< update (from 0), its scan
  mutable mrpt::maps::CMultiMetricMap metricMap_;
};

}  // namespace hybrid_slam
