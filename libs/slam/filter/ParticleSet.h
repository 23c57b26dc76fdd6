/// @file ParticleSet.h
/// @brief The particles and the steps of the filter: Sec. III-A, steps 1 to 4.
#pragma once

#include <mrpt/system/CTimeLogger.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "slam/filter/FilterOptions.h"
#include "slam/filter/FilterView.h"
#include "slam/filter/ImprovedProposal.h"
#include "slam/filter/MrptParticles.h"
#include "slam/filter/ParticleNumber.h"

namespace hybrid_slam {

/// All particles, with the steps that change them together.
class ParticleSet : public MrptParticles {
 public:
  /// @param profiler  records the times of sampling and resampling; must outlive the set
  explicit ParticleSet(const FilterConfiguration& configuration,
                       mrpt::system::CTimeLogger* profiler = nullptr);
  ParticleSet(const ParticleSet&) = delete;
  ParticleSet& operator=(const ParticleSet&) = delete;

  /// Places all particles at `start`, with empty maps and equal weights.
  void reset(const mrpt::math::TPose2D& start);
  /// Replaces the particles by one at each pose, with equal weights and this map, to localise in it. Disables
  /// the search of the whole map for a robot that was carried.
  void place(const std::vector<mrpt::math::TPose2D>& poses, const OccupancyGrid& grid,
             const LineDatabase& lines);
  /// Starts the next step: new random streams, and a new record in lastStep.
  void beginStep();
  /// Moves every particle by `motion` without sampling or weighing, while there is no map.
  void appendPose(const mrpt::math::TPose2D& motion);
  /// Clears the paths but keeps the maps: every particle continues from `start`.
  void startPathAt(const mrpt::math::TPose2D& start);

  /// Steps 1 and 2: draws every particle's pose from the configured proposal and weighs it by the scan.
  /// @param odometry  since the previous step (m, rad)
  void sampleAndWeigh(const mrpt::math::TPose2D& odometry, const PreparedScan& scan);
  /// Step 3: resamples if the effective sample size is below the threshold.
  void resampleIfDue();
  /// Step 4, map estimation: inserts the scan into the grids and the lines into the databases, at each
  /// particle's pose.
  void updateMaps(const PreparedScan& scan);

  /// Makes all particles copies of the best one with this path and map.
  void continueFrom(const std::vector<mrpt::math::TPose2D>& path, const OccupancyGrid& grid,
                    const LineDatabase& lines, const FeatureDatabase& features);
  /// Records in lastStep that a loop was closed.
  void setLoop(const LoopClosure& closure) { step_.loop = closure; }

  const Particle& best() const;  ///< argmax of the weight before resampling
  const FilterStep& lastStep() const { return step_; }
  std::vector<WeightedPose> poses() const;
  /// Returns whether every particle's path has this many poses.
  bool arePathsOf(size_t length) const {
    return std::all_of(m_particles.begin(), m_particles.end(),
                       [length](const auto& particle) { return particle.d->path.size() == length; });
  }

  template <class State>
  void visit(State& state) {
    size_t count = m_particles.size();
    state(count);
    if constexpr (State::kIsReading) m_particles.clear();
    for (size_t i = 0; i < count; ++i) {
      if constexpr (State::kIsReading) m_particles.emplace_back().d.reset(new Particle());
      state(*m_particles[i].d, m_particles[i].log_w);
      if (features_.enabled) {
        state(m_particles[i].d->features);
        state.check(bool(m_particles[i].d->features), "a particle has no features");
      }
      state.check(m_particles[i].d->grid.resolution() == grid_.resolution, "a grid has other cells");
      state.check(m_particles[i].d->motion.isPlausible(motion_), "a motion model is impossible");
    }
    state.check(count > 0 && std::isfinite(logSumOfWeights()), "the particles have no weight");
    state(stepNumber_, slipRecovery_, step_);
  }

 private:
  struct Weight {
    double logGrid;  ///< ln w_grid before tempering; without grids, that of the beams against the lines
    WeightTerms::Value terms;
    /// ln of w_grid^exponent x w_line x w_features: beams are far from independent, so only w_grid is
    /// tempered.
    double log(double exponent) const { return exponent * logGrid + terms.log(); }
  };
  void sampleFromMotionModel(const mrpt::math::TPose2D& odometry, const PreparedScan& scan);
  void sampleAroundMatches(const mrpt::math::TPose2D& odometry, const PreparedScan& observed);
  void sampleByMrpt(const mrpt::math::TPose2D& odometry, const PreparedScan& scan);
  Weight weigh(const Particle& particle, const mrpt::math::TPose2D& pose, const PreparedScan& scan) const;
  void setWeight(Particle& particle, const Weight& weight) const;
  void summarise(const mrpt::math::TPose2D& odometry);
  void proposeAndWeigh(const mrpt::math::TPose2D& odometry, const PreparedScan& scan);
  size_t particlesNeeded() const;
  double logSumOfWeights() const;
  RandomStream stream(size_t particle) const;  ///< the random numbers of a particle in this step
  RandomStream sharedRandom() const;           ///< those of the step that belong to no particle
  template <class Body>
  void forEachParticle(const Body& body);

  bool useLines_, useGrid_, usesMatches_;
  ParticleFilterOptions filter_;
  MotionModelOptions motion_;
  GridOptions grid_;
  double exponent_, improvedExponent_;
  AssociationOptions association_;
  LineDatabaseOptions database_;
  FeatureOptions features_;
  mrpt::system::CTimeLogger* profiler_;
  ScanPreparation prepare_;
  GridWeight gridWeight_;
  LineMapWeight lineMapWeight_;
  WeightTerms terms_;
  ImprovedProposal improvedProposal_;
  ScanMatcher matcher_;
  const SlipRecovery newSlipRecovery_;
  SlipRecovery slipRecovery_;
  tbb::task_arena arena_;
  uint64_t stepNumber_ = 0;
  double logSumBefore_ = 0;  ///< ln of the sum of the weights at the start of the step
  FilterStep step_;
};

}  // namespace hybrid_slam
