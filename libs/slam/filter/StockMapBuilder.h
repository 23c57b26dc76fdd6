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

/// Runs MRPT's filter on one thread, with our motion model for the odometry.
class StockMapBuilder : public mrpt::slam::CMetricMapBuilderRBPF, public Filter {
 public:
  /// @param motion     error model of the odometry passed to `process`
  /// @param seed       of this filter's random numbers; other filters and threads do not affect them
  /// @param mostBytes  largest size of the maps of all particles together
  StockMapBuilder(const TConstructionOptions& construction, const MotionModelOptions& motion, uint32_t seed,
                  double mostBytes = std::numeric_limits<double>::infinity());

  /// @throws std::runtime_error if the maps are larger than `mostBytes`, or one has over 2^28 cells
  void process(const mrpt::math::TPose2D& odometry, const Scans& scans) override;

  /// Calls MRPT's function with this filter's random generator, and counts the updates.
  /// @throws std::runtime_error likewise
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
  tbb::task_arena oneThread_{1};  ///< MRPT 2.14.7 would use all cores, 2.5.8 uses one
  size_t updates_ = 0;
  FilterStep step_;
};

/// Reads the settings of MRPT's rbpf-slam: section [MappingApplication] and those that it names.
mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockOptions(
    const mrpt::config::CConfigFileBase& source);
/// Makes MRPT's settings from ours: its standard proposal, with our number of particles, resampling, update
/// distances, cell size and maximum range.
mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockOptions(const ParticleFilterOptions& filter,
                                                                     const GridOptions& grid);

}  // namespace hybrid_slam
