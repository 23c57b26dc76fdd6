/// @file HybridMapBuilder.h
/// @brief HybridFilter as an mrpt::slam::CMetricMapBuilder, like MRPT's own CMetricMapBuilderRBPF.
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/slam/CMetricMapBuilder.h>

#include "base/MrptVersion.h"
#include "slam/filter/HybridFilter.h"

namespace hybrid_slam {

/// The filter for programs that are written for MRPT's map builders.
class HybridMapBuilder : public mrpt::slam::CMetricMapBuilder, public HybridFilter {
 public:
  explicit HybridMapBuilder(const FilterConfiguration& configuration);

  /// Discards the map and starts at x0 (default: the origin). Scans of `initialMap` go into every particle;
  /// the start is then its last pose unless x0 is given.
  void initialize(const mrpt::maps::CSimpleMap& initialMap = mrpt::maps::CSimpleMap(),
                  const mrpt::poses::CPosePDF* x0 = nullptr) override;

  /// Calls HybridFilter::process with the odometry of `action` and all 2D scans of `observations`.
  /// @throws InputError if the action holds no odometry
  void processActionObservation(mrpt::obs::CActionCollection& action,
                                mrpt::obs::CSensoryFrame& observations) override;

  /// The weighted particles, moved by the odometry since the last update.
  mrpt::poses::CPose3DPDF::Ptr getCurrentPoseEstimation() const override;
  /// The initial map, and the remembered scans of the updates at the best particle's poses.
  void getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& map) const override;
  /// The best particle's grid; valid until the next call.
  BuiltMetricMap getCurrentlyBuiltMetricMap() const override;
  unsigned int getCurrentlyBuiltMapSize() override {
    return static_cast<unsigned int>(initialMap_.size() + scans_.size());
  }
  void saveCurrentEstimationToImage(const std::string& file, bool formatEmfBmp = true) override;
  /// The best particle's path, one pose per update.
  void getCurrentMostLikelyPath(std::deque<mrpt::math::TPose3D>& path) const;

  /// Sets whether the scans of later updates are kept for getCurrentlyBuiltMap (default: yes); memory then
  /// grows with the log.
  void rememberScans(bool remember) { remembersScans_ = remember; }

 private:
  bool remembersScans_ = true;
  mrpt::maps::CSimpleMap initialMap_;
  std::vector<std::pair<size_t, mrpt::obs::CSensoryFrame::Ptr>> scans_;  ///< update (from 0), its scans
  mutable mrpt::maps::CMultiMetricMap metricMap_;
};

/// Returns the 2D scans of a sensory frame in its order.
Scans scansOf(const mrpt::obs::CSensoryFrame& observations);

}  // namespace hybrid_slam
