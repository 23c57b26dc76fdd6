/// @file StockMapBuilder.h
/// @brief MRPT's own RBPF behind our filter interface: `--method stock`.
#pragma once

#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMetricMapBuilderRBPF.h>
#include <tbb/task_arena.h>

#include <limits>

#include "slam/filter/Filter.h"
#include "slam/filter/FilterOptions.h"

namespace hybrid_slam {

class StockMapBuilder : public mrpt::slam::CMetricMapBuilderRBPF, public Filter {
 public:
  /// @param motion     motion model of the actions that `process` makes of odometry
  /// @param seed       same seed, same result, in any thread and beside any other filter
  /// @param mostBytes  largest size of the maps of all particles: `process` throws std::runtime_error if they
  ///                   are larger, or if one has over 2^28 cells
  StockMapBuilder(const TConstructionOptions& construction, const MotionModelOptions& motion, uint32_t seed,
                  double mostBytes = std::numeric_limits<double>::infinity());

  void process(const mrpt::math::TPose2D& odometry, const Scans& scans) override;

  /// Counts the updates and makes MRPT draw from this filter's generator; the rest is MRPT's.
  void processActionObservation(mrpt::obs::CActionCollection& action,
                                mrpt::obs::CSensoryFrame& observations) override;

  size_t updates() const override { return updates_; }
  const FilterStep& lastStep() const override { return step_; }
  std::vector<mrpt::math::TPose2D> bestPath() const override;
  mrpt::maps::COccupancyGridMap2D bestGrid() const override;
  std::vector<DatabaseLine> bestLines() const override { return {}; }
  double cellSize() const;  ///< m; that of `bestGrid` is a multiple if the map has over 2^28 cells
  std::vector<WeightedPose> particlePoses() const override;

 private:
  void checkSize() const;
  size_t bestParticle() const;

  MotionModelOptions motion_;
  double mostBytes_;
  mrpt::random::CRandomGenerator random_;
  tbb::task_arena oneThread_{1};  ///< MRPT 2.14.7 would weigh the particles on all cores, 2.5.8 does on one
  size_t updates_ = 0;
  FilterStep step_;
};

/// MRPT's settings as in its rbpf-slam: section [MappingApplication] and the sections it names.
mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockOptions(
    const mrpt::config::CConfigFileBase& source);
/// MRPT's standard proposal with our number of particles, resampling, update distances and cell size.
mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockOptions(const FilterConfiguration& ours);

}  // namespace hybrid_slam
