#include "slam/filter/ParticleSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/RandomStream.h"
#include "slam/filter/Threads.h"
#include "slam/motion/SpreadNormals.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

/// Records the time of its scope, if there is a profiler.
class StageTimer {
 public:
  StageTimer(mrpt::system::CTimeLogger* profiler, const char* stage) {
    if (profiler) entry_.emplace(*profiler, stage);
  }

 private:
  std::optional<mrpt::system::CTimeLoggerEntry> entry_;
};

}  // namespace

ParticleSet::ParticleSet(const FilterConfiguration& c, mrpt::system::CTimeLogger* profiler)
    : MrptParticles(c.filter),
      useLines_(c.useLines),
      useGrid_(c.useGrid),
      usesMatches_(c.usesMatches()),
      filter_(c.filter),
      motion_(c.motion),
      grid_(c.grid),
      exponent_(c.useGrid ? c.gridWeight.exponent : c.lineMap.exponent),
      improvedExponent_(c.improved.exponent),
      association_(c.association),
      database_(c.databaseOptions()),
      features_(c.features),
      profiler_(profiler),
      prepare_(c),
      gridWeight_(c.gridWeight, c.grid.resolution),
      lineMapWeight_(c.lineMap, c.grid.maxRange),
      terms_(c),
      improvedProposal_(c.improved, c.motion, c.matcher, terms_),
      matcher_(c.matcher),
      newSlipRecovery_(c),
      slipRecovery_(newSlipRecovery_),
      arena_(arenaThreads(c.filter.threads)) {}

template <class Body>
void ParticleSet::forEachParticle(const Body& body) {
  parallelFor(arena_, 0, m_particles.size(), [&](size_t i) { body(i, *m_particles[i].d); });
}

void ParticleSet::reset(const TPose2D& start) {
  m_particles.clear();
  Particle particle;
  particle.grid = OccupancyGrid(grid_.resolution);
  particle.path.push(start);
  const int number =
      filter_.isAdaptive() && !filter_.isAuxiliary() ? filter_.minParticles : filter_.fixedParticles();
  for (int i = 0; i < number; ++i) {
    m_particles.emplace_back();
    m_particles.back().d.reset(new Particle(particle));
    m_particles.back().log_w = 0;
  }
  stepNumber_ = 0;
  slipRecovery_ = newSlipRecovery_;  // the usual fit belongs to the old map
}

void ParticleSet::place(const std::vector<TPose2D>& poses, const OccupancyGrid& grid,
                        const LineDatabase& lines) {
  m_particles.clear();
  Particle particle;
  particle.grid = grid;
  particle.lines = CowPtr<LineDatabase>(lines);
  for (const TPose2D& pose : poses) {
    m_particles.emplace_back();
    m_particles.back().d.reset(new Particle(particle));
    m_particles.back().d->path.push(pose);
    m_particles.back().log_w = 0;
  }
  slipRecovery_ = newSlipRecovery_;
  slipRecovery_.searchOnlyNearby();
}

void ParticleSet::beginStep() {
  ++stepNumber_;
  step_ = FilterStep();
  step_.particles = m_particles.size();
  step_.resampled = false;
  logSumBefore_ = logSumOfWeights();
  seedStep(sharedRandom());
}

RandomStream ParticleSet::sharedRandom() const { return stream(m_particles.size()); }

RandomStream ParticleSet::stream(size_t particle) const {
  return RandomStream(static_cast<uint64_t>(filter_.seed), stepNumber_, particle);
}

void ParticleSet::appendPose(const TPose2D& motion) {
  Path from, to;  // particles that share a path keep sharing it
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

// Sec. III-A, steps 1 and 2.
void ParticleSet::sampleAndWeigh(const TPose2D& odometry, const PreparedScan& scan) {
  const StageTimer timer(profiler_, "3 sample, weigh");
  proposeAndWeigh(odometry, scan);
  if (!useGrid_) return;
  const Particle& bestParticle = best();
  ScanLikelihood likelihood = matcher_.likelihood(scan.matchedBeams, bestParticle.grid);
  step_.degeneracy = degeneracy(scanInformation(likelihood, bestParticle.path.back()));
}

void ParticleSet::proposeAndWeigh(const TPose2D& odometry, const PreparedScan& scan) {
  if (filter_.isAuxiliary()) return sampleByMrpt(odometry, scan);
  if (usesMatches_) return sampleAroundMatches(odometry, scan);
  sampleFromMotionModel(odometry, scan);
}

// The order of Fig. 1: sample from the motion model, weigh by w_grid x w_line.
void ParticleSet::sampleFromMotionModel(const TPose2D& odometry, const PreparedScan& scan) {
  const SpreadNormals normals(stream(m_particles.size() + 1));  // after the particles' and the shared one
  forEachParticle([&](size_t i, Particle& particle) {
    const MotionModelOptions model = particle.motion.model(motion_);
    particle.path.push(particle.path.back() + sampleMotion(odometry, model, normals(i)));
    particle.motion.learn(odometry, particle.path.lastMotion(), motion_);
    const Weight weight = weigh(particle, particle.path.back(), scan);
    setWeight(particle, weight);
    m_particles[i].log_w += weight.log(exponent_);
  });
  summarise(odometry);
}

// The paper's [5]: sample around a scan match instead. Beams at people are left out, as seen from the match
// of the best particle.
void ParticleSet::sampleAroundMatches(const TPose2D& odometry, const PreparedScan& observed) {
  const std::vector<StepMotion> motions = slipRecovery_.motionsOf(best(), odometry, observed);
  const PreparedScan scan =
      prepare_.withoutMovedThings(observed, best().path.back() + motions[0].start, best().grid);
  forEachParticle([&](size_t i, Particle& particle) {
    RandomStream random = stream(i);
    const StepMotion& motion = motions[i % motions.size()];
    const auto proposed = improvedProposal_.propose(particle, motion, scan, random);
    particle.path.push(proposed.pose);
    if (!motion.hasSlipped) particle.motion.learn(motion.odometry, particle.path.lastMotion(), motion_);
    particle.gridWeight = proposed.fit;
    particle.lineWeight = proposed.lineWeight;
    particle.isMatched = proposed.isMatched;
    m_particles[i].log_w += improvedExponent_ * proposed.logWeight;
  });
  summarise(odometry);
  step_.slipped = motions[0].hasSlipped;
  const auto matched = std::count_if(m_particles.begin(), m_particles.end(),
                                     [](const auto& particle) { return particle.d->isMatched; });
  step_.matched = static_cast<double>(matched) / static_cast<double>(m_particles.size());
}

// MRPT's auxiliary filters, which resample as they sample.
void ParticleSet::sampleByMrpt(const TPose2D& odometry, const PreparedScan& scan) {
  auxiliaryStep(odometry, motion_, [&](const Particle& particle, const TPose2D& pose) {
    return weigh(particle, pose, scan).log(exponent_);
  });
  forEachParticle([&](size_t, Particle& p) { setWeight(p, weigh(p, p.path.back(), scan)); });
  summarise(odometry);
  step_.resampled = hasResampled();
}

// Sec. III-D: w_grid by a penetration model after the paper's [4], w_line by eq. (9) or a smooth match.
ParticleSet::Weight ParticleSet::weigh(const Particle& particle, const TPose2D& pose,
                                       const PreparedScan& scan) const {
  Weight weight;
  if (!useGrid_) {
    weight.logGrid = lineMapWeight_.meanLogLikelihood(scan.weighedBeams, pose, *particle.lines);
    weight.terms.line.seen = static_cast<int>(scan.lines.size());
    return weight;
  }
  weight.logGrid = gridWeight_.logWeight(scan.weighedBeams, scan.scans, pose, particle.grid);
  weight.terms = terms_.at(particle, pose, scan);
  return weight;
}

void ParticleSet::setWeight(Particle& particle, const Weight& weight) const {
  particle.gridWeight = std::exp(weight.logGrid);
  particle.lineWeight = weight.terms.line;
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
  normalizeWeights();  // else ESS() underflows if all particles fit badly
  for (auto& particle : m_particles) particle.d->logWeight = particle.log_w;
  const Particle& bestParticle = best();
  step_.ess = ESS();
  step_.gridWeight = bestParticle.gridWeight;
  if (useLines_) step_.lineWeight = bestParticle.lineWeight.value;
  step_.linesSeen = bestParticle.lineWeight.seen;
  step_.linesMatched = bestParticle.lineWeight.matched;
  step_.frames = terms_.frames(bestParticle);
  setSpread(step_, poses(), bestParticle.path.back().phi);
}

size_t ParticleSet::particlesNeeded() const {
  if (!filter_.isAdaptive()) return m_particles.size();
  const double needed = kldParticles(occupiedBins(step_.poses));
  return static_cast<size_t>(
      std::clamp(std::ceil(needed), 1.0 * filter_.minParticles, 1.0 * filter_.maxParticles));
}

// Sec. III-A, step 3; by ESS, where the paper resamples at every step.
void ParticleSet::resampleIfDue() {
  if (filter_.isAuxiliary()) return;
  const size_t needed = particlesNeeded(), present = m_particles.size();
  // Without hysteresis, the number would change at every step.
  if (!isResamplingDue() && 4 * needed < 5 * present && 3 * needed > 2 * present) return;
  const StageTimer timer(profiler_, "4 resample");
  resample(needed);
  step_.resampled = hasResampled();
}

// Sec. III-A, step 4. Copies made by resampling are adjacent and share their path: the first one is updated,
// the others copy its map.
void ParticleSet::updateMaps(const PreparedScan& scan) {
  const auto isCopy = [this](size_t i) {
    return i > 0 && m_particles[i].d->path.sharesWith(m_particles[i - 1].d->path);
  };
  forEachParticle([&](size_t i, Particle& particle) {
    if (isCopy(i)) return;
    const TPose2D pose = particle.path.back();
    if (useGrid_) particle.grid.insert(scan.beams, pose, grid_);
    if (useLines_) particle.lines.write().update(transformed(scan.lines, pose), database_, association_);
    if (features_.enabled) {
      std::vector<PointFeature> features;
      for (const PointFeature& feature : scan.features) features.push_back(transformed(feature, pose));
      particle.features.write().update(features, features_);
    }
  });
  for (size_t i = 1; i < m_particles.size(); ++i)
    if (isCopy(i)) {
      m_particles[i].d->grid = m_particles[i - 1].d->grid;
      m_particles[i].d->lines = m_particles[i - 1].d->lines;
      m_particles[i].d->features = m_particles[i - 1].d->features;
    }
}

void ParticleSet::continueFrom(const std::vector<TPose2D>& path, const OccupancyGrid& grid,
                               const LineDatabase& lines, const FeatureDatabase& features) {
  Particle corrected = best();
  corrected.path = Path();
  for (const TPose2D& pose : path) corrected.path.push(pose);
  corrected.grid = grid;
  corrected.lines = CowPtr<LineDatabase>(lines);
  corrected.features = CowPtr<FeatureDatabase>(features);
  corrected.logWeight = 0;
  for (auto& particle : m_particles) {
    *particle.d = corrected;
    particle.log_w = 0;
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

}  // namespace hybrid_slam
