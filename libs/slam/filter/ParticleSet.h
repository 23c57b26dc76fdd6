/// @file ParticleSet.h
/// @brief The particles on MRPT's particle-filter scaffolding: Sec. III-A, steps 1 to 4.
#pragma once

#include <mrpt/bayes/CParticleFilterData.h>
#include <mrpt/slam/PF_implementations_data.h>
#include <mrpt/system/CTimeLogger.h>
#include <tbb/task_arena.h>

#include <array>

#include "slam/filter/FilterOptions.h"
#include "slam/filter/FilterView.h"
#include "slam/filter/ImprovedProposal.h"
#include "slam/filter/Particle.h"

namespace hybrid_slam {

class ParticleSet
    : public mrpt::bayes::CParticleFilterData<Particle>,
      public mrpt::bayes::CParticleFilterDataImpl<ParticleSet,
                                                  mrpt::bayes::CParticleFilterData<Particle>::CParticleList>,
      public mrpt::slam::PF_implementation<Particle, ParticleSet,
                                           mrpt::bayes::particle_storage_mode::POINTER> {
 public:
  /// @param profiler  takes the times of sampling and resampling; outlives the set
  explicit ParticleSet(const FilterConfiguration& configuration,
                       mrpt::system::CTimeLogger* profiler = nullptr);
  ParticleSet(const ParticleSet&) = delete;
  ParticleSet& operator=(const ParticleSet&) = delete;

  /// All particles at `start` with empty maps; nothing has been weighed.
  void reset(const mrpt::math::TPose2D& start);
  /// Readies the next step: its scan, and the random streams of its number.
  void beginStep(const PreparedScan& scan);
  /// Moves every particle by `motion` without sampling or weighing: while there is no map.
  void appendPose(const mrpt::math::TPose2D& motion);
  /// Forgets the paths so far, keeps the maps: every particle goes on from `start`.
  void startPathAt(const mrpt::math::TPose2D& start);
  /// Step 4, map estimation: scan into the grids, lines into the databases, at each particle's pose.
  void updateMaps();

  const Particle& best() const;  ///< argmax of the weight before resampling
  const FilterStep& lastStep() const { return step_; }
  std::vector<WeightedPose> poses() const;

  /// Also gives all particles the same weight again, which MRPT 2.5.8 forgets, and draws by itself for the
  /// residual scheme, which is biased there (doc/mrpt-notes.md).
  void performSubstitution(const std::vector<size_t>& indices) override;

  /// @name What MRPT's PF_implementation asks for
  /// @{
  mrpt::math::TPose3D getLastPose(size_t i, bool& isValid) const override;
  void PF_SLAM_implementation_custom_update_particle_with_new_pose(
      Particle* particle, const mrpt::math::TPose3D& pose) const override;
  double PF_SLAM_computeObservationLikelihoodForParticle(
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& options, size_t particle,
      const mrpt::obs::CSensoryFrame& observation, const mrpt::poses::CPose3D& pose) const override;
  /// @}

 protected:
  void prediction_and_update_pfStandardProposal(
      const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& PF_options) override;
  void prediction_and_update_pfOptimalProposal(
      const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& PF_options) override;
  void prediction_and_update_pfAuxiliaryPFStandard(
      const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& PF_options) override;
  void prediction_and_update_pfAuxiliaryPFOptimal(
      const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& PF_options) override;

 private:
  struct Weight {
    double logGrid;  ///< ln w_grid before tempering
    LineWeight line;
    double log(double exponent) const;
  };
  RandomStream stream(size_t particle) const;  ///< the random numbers of a particle in this step
  Weight weigh(const Particle& particle, const mrpt::math::TPose2D& pose) const;
  /// The random numbers of the step that belong to no particle.
  RandomStream sharedRandom() const;
  void setWeight(Particle& particle, const Weight& weight) const;
  void summarise(const mrpt::math::TPose2D& odometry);
  double logSumOfWeights() const;
  /// Steps 1 and 2 for one particle: moves it and returns by how much its log-weight grows.
  double sampleAndWeigh(Particle& particle, const mrpt::math::TPose2D& odometry,
                        const std::array<double, 3>& normals) const;
  template <class Body>
  void forEachParticle(const Body& body);

  FilterConfiguration configuration_;
  mrpt::system::CTimeLogger* profiler_;
  GridWeight gridWeight_;
  ImprovedProposal improvedProposal_;
  SlipRecovery slipRecovery_;
  tbb::task_arena arena_;
  const PreparedScan* scan_ = nullptr;
  uint64_t stepNumber_ = 0;
  double logSumBefore_ = 0;  ///< ln of the sum of weights, at the start of the step
  FilterStep step_;
};

}  // namespace hybrid_slam
