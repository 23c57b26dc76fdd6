#include "slam/filter/MrptParticles.h"

// PF_implementations.h of MRPT 2.5.8 needs these before it.
#include <mrpt/bayes/CParticleFilterCapable.h>
#include <mrpt/obs/CSensoryFrame.h>
namespace mrpt::slam {
using mrpt::bayes::INVALID_LIKELIHOOD_VALUE;
}
#include <mrpt/slam/PF_implementations.h>

#include <cmath>
#include <limits>

#include "base/Errors.h"
#include "slam/filter/Resampling.h"

namespace hybrid_slam {
/// The bins that MRPT's templates require for KLD sampling. The number of particles is fixed here, so one bin
/// is enough.
struct OneBin {
  struct lt_operator {
    bool operator()(const OneBin&, const OneBin&) const { return false; }
  };
};
}  // namespace hybrid_slam

namespace mrpt::slam {
template <>
void KLF_loadBinFromParticle(hybrid_slam::OneBin&, const TKLDParams&, const hybrid_slam::Particle*,
                             const mrpt::math::TPose3D*) {}
}  // namespace mrpt::slam

namespace hybrid_slam {

using mrpt::bayes::CParticleFilter;
using mrpt::math::TPose2D;
using Proposal = ParticleFilterOptions::Proposal;

namespace {

CParticleFilter::TParticleFilterOptions mrptOptions(const ParticleFilterOptions& options) {
  if (options.isAdaptive() && options.minParticles > options.maxParticles)
    throw InputError("min_particles is larger than max_particles",
                     "section [particle_filter], keys `min_particles`, `max_particles`",
                     "expected at most " + std::to_string(options.maxParticles));
  if (options.isAuxiliary() && options.resampling == CParticleFilter::prResidual)
    throw InputError("residual resampling is biased in MRPT's auxiliary filters",
                     "section [particle_filter], keys `proposal`, `resampling`",
                     "expected another scheme or the standard proposal");
  CParticleFilter::TParticleFilterOptions out;
  out.PF_algorithm = options.proposal == Proposal::auxiliaryOptimal ? CParticleFilter::pfAuxiliaryPFOptimal
                                                                    : CParticleFilter::pfAuxiliaryPFStandard;
  out.resamplingMethod = options.resampling;
  out.sampleSize = static_cast<unsigned int>(options.fixedParticles());
  out.BETA = options.essThreshold;
  out.adaptiveSampleSize = false;
  // Below this likelihood, MRPT would give a particle the pose of another one, but not its map.
  out.max_loglikelihood_dyn_range = std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace

MrptParticles::MrptParticles(const ParticleFilterOptions& options) : options_(mrptOptions(options)) {}

void MrptParticles::seedStep(const RandomStream& random) {
  random_ = random;
  hasResampled_ = false;
  // A new generator, since seeding the old one keeps the second normal number of its last pair.
  RandomStream seed = random;
  mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(static_cast<uint32_t>(seed.bits()));
}

void MrptParticles::performSubstitution(const std::vector<size_t>& indices) {
  RandomStream random = random_;
  const bool isResidual = options_.resamplingMethod == CParticleFilter::prResidual;
  substitute(isResidual ? residualResampling(logWeights(), random) : indices);
}

void MrptParticles::substitute(const std::vector<size_t>& indices) {
  CParticleFilterDataImpl::performSubstitution(indices);
  for (auto& particle : m_particles) particle.log_w = 0;
  hasResampled_ = true;
}

std::vector<double> MrptParticles::logWeights() const {
  std::vector<double> weights;
  for (const auto& particle : m_particles) weights.push_back(particle.log_w);
  return weights;
}

// MRPT's schemes resample to the same number: to more they read past their draws, to fewer they leave out the
// last particles.
void MrptParticles::resample(size_t particles) {
  if (particles == m_particles.size()) return performResampling(options_);
  RandomStream random = random_;
  substitute(systematicResampling(logWeights(), particles, random));
}

void MrptParticles::auxiliaryStep(const TPose2D& odometry, const MotionModelOptions& motion,
                                  const LogWeightAt& logWeightAt) {
  hasResampled_ = isResamplingDue();  // by the weights of the previous step
  mrpt::obs::CActionCollection action;
  action.insert(toAction(odometry, motion));
  const mrpt::obs::CSensoryFrame unused;  // logWeightAt has the scan
  logWeightAt_ = logWeightAt;
  const struct Reset {  // also if weighing throws
    LogWeightAt& function;
    ~Reset() { function = nullptr; }
  } reset{logWeightAt_};
  if (options_.PF_algorithm == CParticleFilter::pfAuxiliaryPFOptimal)
    PF_SLAM_implementation_pfAuxiliaryPFOptimal<OneBin>(&action, &unused, options_, {});
  else
    PF_SLAM_implementation_pfAuxiliaryPFStandard<OneBin>(&action, &unused, options_, {});
}

mrpt::math::TPose3D MrptParticles::getLastPose(size_t i, bool& isValid) const {
  isValid = true;
  return mrpt::math::TPose3D(m_particles[i].d->path.back());
}

void MrptParticles::PF_SLAM_implementation_custom_update_particle_with_new_pose(
    Particle* particle, const mrpt::math::TPose3D& pose) const {
  particle->path.push(TPose2D(pose));
}

double MrptParticles::PF_SLAM_computeObservationLikelihoodForParticle(
    const CParticleFilter::TParticleFilterOptions& /*options*/, size_t particle,
    const mrpt::obs::CSensoryFrame& /*observation*/, const mrpt::poses::CPose3D& pose) const {
  return logWeightAt_(*m_particles[particle].d, TPose2D(pose.asTPose()));
}

}  // namespace hybrid_slam
