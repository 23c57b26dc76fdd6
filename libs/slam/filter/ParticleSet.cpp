#include "slam/filter/ParticleSet.h"

// PF_implementations.h of MRPT 2.5.8 needs these two before it.
#include <mrpt/bayes/CParticleFilterCapable.h>
#include <mrpt/obs/CSensoryFrame.h>
namespace mrpt::slam {
using mrpt::bayes::INVALID_LIKELIHOOD_VALUE;
}
#include <mrpt/slam/PF_aux_structs.h>
#include <mrpt/slam/PF_implementations.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/RandomStream.h"
#include "slam/filter/Resampling.h"
#include "slam/filter/Threads.h"
#include "slam/motion/SpreadNormals.h"

namespace mrpt::slam {
/// Where a particle falls in the bins of KLD sampling; the number of particles is fixed here, but the
/// templates ask for it.
template <>
void KLF_loadBinFromParticle(detail::TPoseBin2D& bin, const TKLDParams& options,
                             const hybrid_slam::Particle* particle, const mrpt::math::TPose3D* newPose) {
  const mrpt::math::TPose2D pose = newPose ? mrpt::math::TPose2D(*newPose) : particle->path.back();
  bin.x = static_cast<int>(std::lround(pose.x / options.KLD_binSize_XY));
  bin.y = static_cast<int>(std::lround(pose.y / options.KLD_binSize_XY));
  bin.phi = static_cast<int>(std::lround(pose.phi / options.KLD_binSize_PHI));
}
}  // namespace mrpt::slam

namespace hybrid_slam {

using mrpt::math::TPose2D;
using mrpt::slam::detail::TPoseBin2D;
using PfOptions = mrpt::bayes::CParticleFilter::TParticleFilterOptions;

namespace {

/// Of the one movement in an action. getBestMovementEstimation would find none of great uncertainty, such as
/// of a step of 60 m.
TPose2D rawOdometry(const mrpt::obs::CActionCollection& action) {
  return action.getActionByClass<mrpt::obs::CActionRobotMovement2D>()->rawOdometryIncrementReading.asTPose();
}

/// Notes the time from here to the end of its scope, if there is a profiler.
class StageTimer {
 public:
  StageTimer(mrpt::system::CTimeLogger* profiler, const char* stage) {
    if (profiler) entry_.emplace(*profiler, stage);
  }

 private:
  std::optional<mrpt::system::CTimeLoggerEntry> entry_;
};

}  // namespace

ParticleSet::ParticleSet(const FilterConfiguration& configuration, mrpt::system::CTimeLogger* profiler)
    : configuration_(configuration),
      profiler_(profiler),
      gridWeight_(configuration.gridWeight, configuration.grid.resolution),
      improvedProposal_(configuration),
      slipRecovery_(configuration),
      arena_(arenaThreads(configuration.filter.threads)) {}

template <class Body>
void ParticleSet::forEachParticle(const Body& body) {
  arena_.execute([&] {
    tbb::parallel_for(size_t{0}, m_particles.size(), [&](size_t i) { body(i, *m_particles[i].d); });
  });
}

void ParticleSet::reset(const TPose2D& start) {
  m_particles.clear();
  Particle particle;
  particle.grid = OccupancyGrid(configuration_.grid.resolution);
  particle.path.push(start);
  for (int i = 0; i < configuration_.filter.particles; ++i) {
    m_particles.emplace_back();
    m_particles.back().d.reset(new Particle(particle));
    m_particles.back().log_w = 0;
  }
  stepNumber_ = 0;
  slipRecovery_ = SlipRecovery(configuration_);  // what fits usually is known of the old map alone
}

void ParticleSet::beginStep(const PreparedScan& scan) {
  scan_ = &scan;
  ++stepNumber_;
  step_ = FilterStep();
  step_.particles = m_particles.size();
  step_.resampled = false;
  logSumBefore_ = logSumOfWeights();
  // MRPT's resampling and auxiliary filters draw from this thread's generator. A new one, since seeding the
  // old one keeps the second normal number of its last pair.
  mrpt::random::getRandomGenerator() =
      mrpt::random::CRandomGenerator(static_cast<uint32_t>(sharedRandom().bits()));
}

RandomStream ParticleSet::sharedRandom() const { return stream(m_particles.size()); }

RandomStream ParticleSet::stream(size_t particle) const {
  return RandomStream(static_cast<uint64_t>(configuration_.filter.seed), stepNumber_, particle);
}

void ParticleSet::appendPose(const TPose2D& motion) {
  Path from, to;  // particles that share a path go on sharing it
  for (auto& particle : m_particles) {
    if (from.empty() || !particle.d->path.sharesWith(from)) {
      from = to = particle.d->path;
      to.push(from.back() + motion);
    }
    particle.d->path = to;
  }
}

void ParticleSet::startPathAt(const TPose2D& start) {
  Path path;
  path.push(start);
  for (auto& particle : m_particles) particle.d->path = path;
}

// Sec. III-A, steps 1 and 2, as in Fig. 1: sample from the motion model, weigh by w_grid x w_line.
double ParticleSet::sampleAndWeigh(Particle& particle, const TPose2D& odometry,
                                   const std::array<double, 3>& normals) const {
  const MotionModelOptions model = particle.motion.model(configuration_.motion);
  particle.path.push(particle.path.back() + sampleMotion(odometry, model, normals));
  particle.motion.learn(odometry, particle.path.lastMotion(), configuration_.motion);
  const Weight weight = weigh(particle, particle.path.back());
  setWeight(particle, weight);
  return weight.log(configuration_.gridWeight.exponent);
}

void ParticleSet::prediction_and_update_pfStandardProposal(const mrpt::obs::CActionCollection* action,
                                                           const mrpt::obs::CSensoryFrame* /*observation*/,
                                                           const PfOptions& /*PF_options*/) {
  const StageTimer timer(profiler_, "3 sample, weigh");
  const TPose2D odometry = rawOdometry(*action);
  const SpreadNormals normals(stream(m_particles.size() + 1));  // after the particles' and the shared one
  forEachParticle([&](size_t i, Particle& particle) {
    m_particles[i].log_w += sampleAndWeigh(particle, odometry, normals(i));
  });
  summarise(odometry);
}

// The paper's [5]: sample around a scan match instead.
void ParticleSet::prediction_and_update_pfOptimalProposal(const mrpt::obs::CActionCollection* action,
                                                          const mrpt::obs::CSensoryFrame* /*observation*/,
                                                          const PfOptions& /*PF_options*/) {
  const StageTimer timer(profiler_, "3 sample, weigh");
  const StepMotion motion = slipRecovery_.motionOf(best(), rawOdometry(*action), *scan_);
  forEachParticle([&](size_t i, Particle& particle) {
    RandomStream random = stream(i);
    const auto proposed = improvedProposal_.propose(particle, motion, *scan_, random);
    particle.path.push(proposed.pose);
    if (!motion.hasSlipped)
      particle.motion.learn(motion.odometry, particle.path.lastMotion(), configuration_.motion);
    particle.gridWeight = proposed.fit;
    particle.lineWeight = proposed.lineWeight;
    particle.isMatched = proposed.isMatched;
    m_particles[i].log_w += configuration_.improved.exponent * proposed.logWeight;
  });
  summarise(motion.odometry);
  step_.slipped = motion.hasSlipped;
  const auto matched = std::count_if(m_particles.begin(), m_particles.end(),
                                     [](const auto& particle) { return particle.d->isMatched; });
  step_.matched = static_cast<double>(matched) / static_cast<double>(m_particles.size());
}

void ParticleSet::prediction_and_update_pfAuxiliaryPFStandard(const mrpt::obs::CActionCollection* action,
                                                              const mrpt::obs::CSensoryFrame* observation,
                                                              const PfOptions& PF_options) {
  const StageTimer timer(profiler_, "3 sample, weigh");  // resampling among them
  step_.resampled = ESS() < PF_options.BETA;             // by the weights of the step before
  PF_SLAM_implementation_pfAuxiliaryPFStandard<TPoseBin2D>(action, observation, PF_options, {});
  forEachParticle([&](size_t, Particle& p) { setWeight(p, weigh(p, p.path.back())); });
  summarise(rawOdometry(*action));
}

void ParticleSet::prediction_and_update_pfAuxiliaryPFOptimal(const mrpt::obs::CActionCollection* action,
                                                             const mrpt::obs::CSensoryFrame* observation,
                                                             const PfOptions& PF_options) {
  const StageTimer timer(profiler_, "3 sample, weigh");  // resampling among them
  step_.resampled = ESS() < PF_options.BETA;
  PF_SLAM_implementation_pfAuxiliaryPFOptimal<TPoseBin2D>(action, observation, PF_options, {});
  forEachParticle([&](size_t, Particle& p) { setWeight(p, weigh(p, p.path.back())); });
  summarise(rawOdometry(*action));
}

// Sec. III-D.
ParticleSet::Weight ParticleSet::weigh(const Particle& particle, const TPose2D& pose) const {
  Weight weight;
  weight.logGrid = gridWeight_.logWeight(scan_->weighedBeams, scan_->scan, pose, particle.grid);
  if (configuration_.useLines)
    weight.line = hybrid_slam::lineWeight(scan_->lines, pose.phi, *particle.lines, configuration_.lineWeight);
  return weight;
}

/// w_grid^exponent x w_line: the beams of a scan are far from independent, the directions stay at full
/// strength.
double ParticleSet::Weight::log(double exponent) const { return exponent * logGrid + std::log(line.value); }

void ParticleSet::setWeight(Particle& particle, const Weight& weight) const {
  particle.gridWeight = std::exp(weight.logGrid);
  particle.lineWeight = weight.line;
}

double ParticleSet::logSumOfWeights() const {
  double highest = -std::numeric_limits<double>::infinity();
  for (const auto& particle : m_particles) highest = std::max(highest, particle.log_w);
  double sum = 0;
  for (const auto& particle : m_particles) sum += std::exp(particle.log_w - highest);
  return highest + std::log(sum);
}

void ParticleSet::summarise(const TPose2D& odometry) {
  step_.odometry = odometry;
  for (const auto& particle : m_particles) step_.motions.push_back(particle.d->path.lastMotion());
  step_.logLikelihood = logSumOfWeights() - logSumBefore_;
  normalizeWeights();  // else ESS() underflows where all particles fit badly
  for (auto& particle : m_particles) particle.d->logWeight = particle.log_w;
  const Particle& bestParticle = best();
  step_.ess = ESS();
  step_.gridWeight = bestParticle.gridWeight;
  if (configuration_.useLines) step_.lineWeight = bestParticle.lineWeight.value;
  step_.linesSeen = bestParticle.lineWeight.seen;
  step_.linesMatched = bestParticle.lineWeight.matched;
  setSpread(step_, poses(), bestParticle.path.back().phi);
}

void ParticleSet::performSubstitution(const std::vector<size_t>& indices) {
  const StageTimer timer(profiler_, "4 resample");
  if (configuration_.filter.resampling == mrpt::bayes::CParticleFilter::prResidual) {
    std::vector<double> logWeights;
    for (const auto& particle : m_particles) logWeights.push_back(particle.log_w);
    RandomStream random = sharedRandom();
    CParticleFilterDataImpl::performSubstitution(residualResampling(logWeights, random));
  } else {
    CParticleFilterDataImpl::performSubstitution(indices);
  }
  for (auto& particle : m_particles) particle.log_w = 0;
  step_.resampled = true;
}

// Sec. III-A, step 4. Copies made by resampling stand side by side and share their path: one of them works,
// the others take over its map.
void ParticleSet::updateMaps() {
  const auto isCopy = [this](size_t i) {
    return i > 0 && m_particles[i].d->path.sharesWith(m_particles[i - 1].d->path);
  };
  forEachParticle([&](size_t i, Particle& particle) {
    if (isCopy(i)) return;
    const TPose2D pose = particle.path.back();
    particle.grid.insert(scan_->beams, pose, configuration_.grid);
    if (!configuration_.useLines) return;
    std::vector<LineSegment> lines;
    for (const LineSegment& line : scan_->lines) lines.push_back(transformed(line, pose));
    particle.lines.write().update(lines, configuration_.database, configuration_.association);
  });
  for (size_t i = 1; i < m_particles.size(); ++i)
    if (isCopy(i)) {
      m_particles[i].d->grid = m_particles[i - 1].d->grid;
      m_particles[i].d->lines = m_particles[i - 1].d->lines;
    }
}

const Particle& ParticleSet::best() const {
  return *std::max_element(m_particles.begin(), m_particles.end(), [](const auto& a, const auto& b) {
            return a.d->logWeight < b.d->logWeight;
          })->d;
}

std::vector<WeightedPose> ParticleSet::poses() const {
  std::vector<WeightedPose> all;
  for (const auto& particle : m_particles) all.push_back({particle.d->path.back(), particle.log_w});
  return all;
}

mrpt::math::TPose3D ParticleSet::getLastPose(size_t i, bool& isValid) const {
  isValid = true;
  return mrpt::math::TPose3D(m_particles[i].d->path.back());
}

void ParticleSet::PF_SLAM_implementation_custom_update_particle_with_new_pose(
    Particle* particle, const mrpt::math::TPose3D& pose) const {
  particle->path.push(TPose2D(pose));
}

double ParticleSet::PF_SLAM_computeObservationLikelihoodForParticle(
    const PfOptions& /*options*/, size_t particle, const mrpt::obs::CSensoryFrame& /*observation*/,
    const mrpt::poses::CPose3D& pose) const {
  return weigh(*m_particles[particle].d, TPose2D(pose.asTPose())).log(configuration_.gridWeight.exponent);
}

}  // namespace hybrid_slam
