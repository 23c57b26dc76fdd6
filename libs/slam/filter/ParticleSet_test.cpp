#include "slam/filter/ParticleSet.h"

#include <gtest/gtest.h>

#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

PreparedScan preparedAt(const TPose2D& robot, uint64_t seed) {
  RandomStream random(seed, 0, 0);
  const LaserScans scan{test::scanOf(test::room(), robot, {}, 181, M_PI, 0.01, random)};
  return {scan, ScanBeams(scan), ScanBeams(scan), ScanBeams(scan), {}};
}

FilterConfiguration fourParticles() {
  FilterConfiguration c = test::roomConfiguration();
  c.filter.particles = 4;
  return c;
}

/// The tile where the robot starts.
const Tile* tileOf(const ParticleSet& particles, size_t i) {
  return particles.m_particles[i].d->grid.tiles().tileAt(0, 0);
}

bool sameCells(const OccupancyGrid& a, const OccupancyGrid& b) {
  bool isSame = true;
  for (const auto& [grid, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    grid->tiles().forEachTile([&, other = other](int tx, int ty, const Tile& tile) {
      const auto* twin = other->tiles().tileAt(tx, ty);
      isSame &= twin && twin->cells() == tile.cells();
    });
  return isSame;
}

TEST(ParticleSet, ResetGivesEqualParticlesThatShareEverything) {
  ParticleSet particles(fourParticles());
  particles.reset({1, 2, 0.5});
  ASSERT_EQ(particles.m_particles.size(), 4u);
  for (const auto& particle : particles.m_particles) {
    EXPECT_EQ(particle.log_w, 0);
    EXPECT_EQ(particle.d->path.back(), TPose2D(1, 2, 0.5));
    EXPECT_TRUE(particle.d->path.sharesWith(particles.m_particles[0].d->path));
    EXPECT_TRUE(particle.d->lines.sharesWith(particles.m_particles[0].d->lines));
  }
}

TEST(ParticleSet, ParticlesOnOnePathKeepOneMap) {
  ParticleSet particles(fourParticles());
  particles.reset({});
  const PreparedScan scan = preparedAt({}, 1);
  particles.beginStep();
  particles.appendPose({0.1, 0, 0});
  particles.updateMaps(scan);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(tileOf(particles, i), tileOf(particles, 0));
    EXPECT_TRUE(particles.m_particles[i].d->lines.sharesWith(particles.m_particles[0].d->lines));
  }
  OccupancyGrid alone(0.05);
  alone.insert(scan.beams, {0.1, 0, 0}, GridOptions());
  EXPECT_TRUE(sameCells(particles.m_particles[3].d->grid, alone));
}

TEST(ParticleSet, CopiesKeepOneMapAndOthersTheirOwn) {
  ParticleSet particles(fourParticles());
  particles.reset({});
  const PreparedScan first = preparedAt({}, 1), second = preparedAt({}, 2);
  particles.beginStep();
  particles.updateMaps(first);
  for (size_t i = 0; i < 4; ++i) particles.m_particles[i].d->path.push({0.1 * static_cast<double>(i), 0, 0});
  particles.beginStep();
  particles.performSubstitution({3, 1, 1, 3});
  particles.updateMaps(second);

  const double expected[] = {0.1, 0.1, 0.3, 0.3};  // copies are adjacent
  for (size_t i = 0; i < 4; ++i) {
    const Particle& particle = *particles.m_particles[i].d;
    ASSERT_NEAR(particle.path.back().x, expected[i], 1e-12);
    OccupancyGrid alone(0.05);
    alone.insert(first.beams, {}, GridOptions());
    alone.insert(second.beams, particle.path.back(), GridOptions());
    EXPECT_TRUE(sameCells(particle.grid, alone)) << i;
  }
  EXPECT_EQ(tileOf(particles, 0), tileOf(particles, 1));
  EXPECT_EQ(tileOf(particles, 2), tileOf(particles, 3));
  EXPECT_NE(tileOf(particles, 1), tileOf(particles, 2));
  EXPECT_FALSE(sameCells(particles.m_particles[1].d->grid, particles.m_particles[2].d->grid));
}

TEST(ParticleSet, ResamplingMakesTheWeightsEqualAndIsRecorded) {
  for (const double threshold : {0.0, 0.9}) {
    FilterConfiguration c = fourParticles();
    c.filter.essThreshold = threshold;
    ParticleSet particles(c);
    particles.reset({});
    particles.beginStep();
    for (size_t i = 0; i < 4; ++i) particles.m_particles[i].log_w = -static_cast<double>(i);
    particles.resampleIfDue();
    EXPECT_EQ(particles.lastStep().resampled, threshold > 0);
    for (size_t i = 0; i < 4; ++i)
      EXPECT_EQ(particles.poses()[i].logWeight, threshold > 0 ? 0 : -static_cast<double>(i));
  }
}

/// One step from particles of different weight, with and without resampling after it: the scan's likelihood
/// is the mean of p(scan | pose) under the weights before the step.
TEST(ParticleSet, TheStepHasItsMotionsAndTheLikelihoodOfTheScan) {
  for (const double threshold : {0.0, 1.0}) {
    FilterConfiguration c = fourParticles();
    c.useLines = false;
    c.filter.essThreshold = threshold;
    ParticleSet particles(c);
    particles.reset({1, 0, 0.5});
    const PreparedScan first = preparedAt({1, 0, 0.5}, 1), second = preparedAt({1.2, 0.1, 0.5}, 2);
    particles.beginStep();
    particles.updateMaps(first);
    const auto map = particles.m_particles[0].d->grid;
    for (size_t i = 0; i < 4; ++i) particles.m_particles[i].log_w = -0.5 * static_cast<double>(i);

    particles.beginStep();
    particles.sampleAndWeigh({0.2, 0, 0.1}, second);
    particles.resampleIfDue();

    const FilterStep& step = particles.lastStep();
    EXPECT_EQ(step.resampled, threshold > 0);
    EXPECT_EQ(step.odometry, TPose2D(0.2, 0, 0.1));
    ASSERT_EQ(step.motions.size(), 4u);
    const GridWeight gridWeight(c.gridWeight, c.grid.resolution);
    double weights = 0, likelihood = 0;
    for (size_t i = 0; i < 4; ++i) {
      const TPose2D pose = TPose2D(1, 0, 0.5) + step.motions[i];
      EXPECT_NEAR((pose - step.poses[i].pose).norm(), 0, 1e-12);
      const double w = std::exp(-0.5 * static_cast<double>(i));
      weights += w;
      likelihood += w * std::exp(c.gridWeight.exponent *
                                 gridWeight.logWeight(second.weighedBeams, second.scans, pose, map));
    }
    EXPECT_NEAR(step.logLikelihood, std::log(likelihood / weights), 1e-9);
  }
}

TEST(ParticleSet, TheImprovedProposalsWeightsAreTempered) {
  const auto logWeights = [](double exponent) {
    FilterConfiguration c = fourParticles();
    c.filter.proposal = ParticleFilterOptions::Proposal::improved;
    c.improved.exponent = exponent;
    ParticleSet particles(c);
    particles.reset({1, 0, 0.5});
    const PreparedScan first = preparedAt({1, 0, 0.5}, 1), second = preparedAt({1.2, 0.1, 0.5}, 2);
    particles.beginStep();
    particles.updateMaps(first);
    particles.beginStep();
    particles.sampleAndWeigh({0.2, 0.1, 0}, second);
    std::vector<double> differences;
    for (size_t i = 1; i < 4; ++i)
      differences.push_back(particles.m_particles[i].log_w - particles.m_particles[0].log_w);
    return differences;
  };
  const auto plain = logWeights(1), tempered = logWeights(0.25), none = logWeights(0);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_GT(std::abs(plain[i]), 1e-3);
    EXPECT_NEAR(tempered[i], 0.25 * plain[i], 1e-9);
    EXPECT_EQ(none[i], 0);
  }
}

TEST(ParticleSet, ANewStartKeepsTheMapsAndForgetsThePaths) {
  ParticleSet particles(fourParticles());
  particles.reset({});
  const PreparedScan scan = preparedAt({}, 1);
  particles.beginStep();
  particles.updateMaps(scan);
  const auto* tile = tileOf(particles, 0);
  particles.startPathAt({1, 1, 1});
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(particles.m_particles[i].d->path.poses(), (std::vector<TPose2D>{{1, 1, 1}}));
    EXPECT_EQ(tileOf(particles, i), tile);
  }
}

}  // namespace
}  // namespace hybrid_slam
