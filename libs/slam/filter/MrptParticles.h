/// @file MrptParticles.h
/// @brief MRPT's particle-filter scaffolding: weighted particles, resampling, and the auxiliary filters.
#pragma once

#include <mrpt/bayes/CParticleFilterData.h>
#include <mrpt/slam/PF_implementations_data.h>

#include <functional>
#include <vector>

#include "base/RandomStream.h"
#include "slam/filter/FilterOptions.h"
#include "slam/filter/Particle.h"

namespace hybrid_slam {

/// The parts of MRPT that we use, and their pitfalls (doc/mrpt-notes.md):
///
/// - `m_particles`, log-weights, ESS and four resampling schemes. MRPT does not reset the weights after
///   resampling, and its residual scheme is biased: performSubstitution corrects both.
/// - One generator of random numbers per thread: seedStep replaces it at each step, so that a run does not
///   depend on others in the same thread.
/// - The auxiliary filters, which take the odometry as an action and draw from its Gaussian motion model.
class MrptParticles
    : public mrpt::bayes::CParticleFilterData<Particle>,
      public mrpt::bayes::CParticleFilterDataImpl<MrptParticles,
                                                  mrpt::bayes::CParticleFilterData<Particle>::CParticleList>,
      public mrpt::slam::PF_implementation<Particle, MrptParticles,
                                           mrpt::bayes::particle_storage_mode::POINTER> {
 public:
  /// @throws InputError for residual resampling with an auxiliary filter
  explicit MrptParticles(const ParticleFilterOptions& options);

  /// Resamples: replaces the particles by copies of those with these indices, with equal weights. With the
  /// residual scheme, draws the indices itself.
  void performSubstitution(const std::vector<size_t>& indices) override;

  /// @name Required by MRPT's PF_implementation
  /// @{
  mrpt::math::TPose3D getLastPose(size_t i, bool& isValid) const override;
  void PF_SLAM_implementation_custom_update_particle_with_new_pose(
      Particle* particle, const mrpt::math::TPose3D& pose) const override;
  double PF_SLAM_computeObservationLikelihoodForParticle(
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& options, size_t particle,
      const mrpt::obs::CSensoryFrame& observation, const mrpt::poses::CPose3D& pose) const override;
  /// @}

 protected:
  /// ln of the tempered weight that a particle would have at a pose.
  using LogWeightAt = std::function<double(const Particle&, const mrpt::math::TPose2D&)>;

  /// Seeds MRPT's random numbers for a step.
  void seedStep(const RandomStream& random);
  bool isResamplingDue() const { return ESS() < options_.BETA; }
  /// @param particles  number of particles afterwards
  void resample(size_t particles);
  bool hasResampled() const { return hasResampled_; }  ///< in this step
  /// Samples, weighs and resamples by one of MRPT's auxiliary filters.
  void auxiliaryStep(const mrpt::math::TPose2D& odometry, const MotionModelOptions& motion,
                     const LogWeightAt& logWeightAt);

 private:
  /// Replaces the particles by those with these indices, with equal weights.
  void substitute(const std::vector<size_t>& indices);
  std::vector<double> logWeights() const;

  mrpt::bayes::CParticleFilter::TParticleFilterOptions options_;
  RandomStream random_{0, 0, 0};  ///< of the step
  bool hasResampled_ = false;
  LogWeightAt logWeightAt_;  ///< of auxiliaryStep; empty outside it
};

}  // namespace hybrid_slam
