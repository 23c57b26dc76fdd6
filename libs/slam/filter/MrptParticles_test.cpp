#include "slam/filter/MrptParticles.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <functional>
#include <stdexcept>

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;
using Proposal = ParticleFilterOptions::Proposal;

ParticleFilterOptions optionsWith(Proposal proposal) {
  ParticleFilterOptions options;
  options.proposal = proposal;
  options.particles = 3;
  return options;
}

class Particles : public MrptParticles {
 public:
  explicit Particles(Proposal proposal) : MrptParticles(optionsWith(proposal)) {
    for (int i = 0; i < 3; ++i) {
      m_particles.emplace_back();
      m_particles.back().d.reset(new Particle);
      m_particles.back().d->path.push({});
      m_particles.back().log_w = 0;
    }
    seedStep(RandomStream(1, 0, 0));
  }
  using MrptParticles::auxiliaryStep;
  /// Returns MRPT's weight of the first particle.
  double weigh() const {
    return PF_SLAM_computeObservationLikelihoodForParticle({}, 0, mrpt::obs::CSensoryFrame(),
                                                           mrpt::poses::CPose3D());
  }
};

TEST(MrptParticles, TheWeightOfAStepIsForgottenAfterItAndIfItThrows) {
  const auto one = [](const Particle&, const TPose2D&) { return 0.0; };
  const auto failing = [](const Particle&, const TPose2D&) -> double { throw std::runtime_error("weight"); };
  for (const Proposal proposal : {Proposal::auxiliaryStandard, Proposal::auxiliaryOptimal}) {
    Particles particles(proposal);
    particles.auxiliaryStep({0.1, 0, 0}, MotionModelOptions(), one);
    EXPECT_THROW(particles.weigh(), std::bad_function_call);
    EXPECT_ANY_THROW(particles.auxiliaryStep({0.1, 0, 0}, MotionModelOptions(), failing));
    EXPECT_THROW(particles.weigh(), std::bad_function_call);
  }
}

}  // namespace
}  // namespace hybrid_slam
