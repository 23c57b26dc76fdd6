// What the filter records of a step: degeneracy, direction frames, number of particles.
#include <gtest/gtest.h>

#include "slam/filter/HybridFilter.h"
#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;
using Proposal = ParticleFilterOptions::Proposal;

/// Four particles in a map of the walls, after a step.
struct Stepped {
  Stepped(const FilterConfiguration& c, const Walls& walls)
      : map(mappedFrom({-1, -0.5}, {1, 0.5}, walls, 40)), particles(c) {
    RandomStream random(2, 0, 0);
    const TPose2D start(0.4, 0.3, 0.5), odometry(0.25, 0.01, 0.05);
    scan = prepared(walls, start + odometry, random);
    particles.place(std::vector<TPose2D>(4, start), map.grid, map.lines);
    particles.beginStep();
    particles.sampleAndWeigh(odometry, scan);
  }
  RoomMap map;
  PreparedScan scan;
  ParticleSet particles;
};

TEST(HybridFilter, OdometryThatIsNotFiniteIsAnError) {
  HybridFilter filter(with(Proposal::improved));
  for (const double wrong : {NAN, INFINITY}) EXPECT_THROW(filter.process({0, 0, wrong}, {}), InputError);
  EXPECT_EQ(filter.updates(), 0u);
}

TEST(FilterStep, TheDegeneracyIsThatOfTheScanInTheBestParticlesMap) {
  for (const auto proposal : {Proposal::standard, Proposal::improved}) {
    const FilterConfiguration c = with(proposal);
    const Stepped inRoom(c, room()), inCorridor(c, kCorridor);
    for (const Stepped* stepped : {&inRoom, &inCorridor}) {
      const Particle& best = stepped->particles.best();
      ScanLikelihood likelihood = ScanMatcher(c.matcher).likelihood(stepped->scan.matchedBeams, best.grid);
      ASSERT_TRUE(stepped->particles.lastStep().degeneracy);
      EXPECT_EQ(*stepped->particles.lastStep().degeneracy,
                degeneracy(scanInformation(likelihood, best.path.back())));
    }
    EXPECT_LT(*inCorridor.particles.lastStep().degeneracy, 0.5 * *inRoom.particles.lastStep().degeneracy);
  }
}

TEST(FilterStep, TheFirstUpdateHasNoDegeneracy) {
  HybridFilter filter(with(Proposal::improved));
  for (const DriveStep& step : drive(1)) {
    filter.process(step.odometry, {std::make_shared<mrpt::obs::CObservation2DRangeScan>(step.scan)});
    EXPECT_EQ(filter.lastStep().degeneracy.has_value(), filter.updates() > 1);
  }
  EXPECT_GT(filter.updates(), 10u);
}

TEST(FilterStep, TheFramesAreThoseOfTheBestParticlesLines) {
  const Stepped stepped(with(Proposal::improved), room());
  const auto expected = directionFrames(stepped.particles.best().lines->lines());
  const auto& frames = stepped.particles.lastStep().frames;
  ASSERT_EQ(frames.size(), 1u) << "all walls of the room are parallel or perpendicular";
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_EQ(frames[0].direction, expected[0].direction);
  EXPECT_EQ(frames[0].evidence, expected[0].evidence);
  EXPECT_EQ(frames[0].lines, expected[0].lines);
  EXPECT_NEAR(frames[0].direction, 0, 0.5 * kDegree);
}

TEST(FilterStep, TheFramesInForceAreThoseOfTheLinesNearTheBestParticle) {
  for (const auto proposal : {Proposal::standard, Proposal::improved}) {
    FilterConfiguration c = with(proposal);
    c.lineWeight.radius = 10;
    EXPECT_EQ(Stepped(c, room()).particles.lastStep().frames.size(), 1u);
    c.lineWeight.radius = 0.01;
    const Stepped blind(c, room());
    EXPECT_TRUE(blind.particles.lastStep().frames.empty());
    EXPECT_EQ(blind.particles.lastStep().lineWeight, 1);
  }
}

TEST(FilterStep, WithoutLinesThereAreNoFrames) {
  FilterConfiguration c = with(Proposal::improved);
  c.useLines = false;
  HybridFilter filter(c);
  for (const DriveStep& step : drive(1)) {
    filter.process(step.odometry, {std::make_shared<mrpt::obs::CObservation2DRangeScan>(step.scan)});
    EXPECT_TRUE(filter.lastStep().frames.empty());
  }
}

/// Particles of equal weight: the scans do not matter, the odometry is off by half of the distance.
FilterConfiguration adaptive() {
  FilterConfiguration c = with(Proposal::standard);
  c.useLines = false;
  c.filter.particles = 0, c.filter.minParticles = 10, c.filter.maxParticles = 40;
  c.gridWeight.exponent = 0;
  for (MotionTerm* term : {&c.motion.distance, &c.motion.drift, &c.motion.turn}) term->meanStd = 0;
  c.motion.distance.varianceD = 0.25;
  return c;
}

TEST(ParticleSet, TheNumberOfParticlesFollowsTheirSpread) {
  ParticleSet particles(adaptive());
  particles.reset({});
  RandomStream random(1, 0, 0);
  const PreparedScan scan = prepared(room(), {}, random);
  particles.beginStep();
  particles.updateMaps(scan);
  EXPECT_EQ(particles.m_particles.size(), 10u);

  // Spread over metres, nearly every particle is in a bin of its own, and n bins need 2 (n - 1) or more.
  particles.beginStep();
  EXPECT_EQ(particles.lastStep().particles, 10u);
  particles.sampleAndWeigh({2, 0, 0}, scan);
  particles.resampleIfDue();
  const size_t many = particles.m_particles.size();
  EXPECT_GT(many, 15u);
  EXPECT_LE(many, 40u);
  EXPECT_EQ(particles.lastStep().resampled, true);

  // All weight on one particle: one bin.
  for (size_t i = 1; i < many; ++i) particles.m_particles[i].log_w = -100;
  particles.beginStep();
  EXPECT_EQ(particles.lastStep().particles, many);
  particles.sampleAndWeigh({}, scan);
  particles.resampleIfDue();
  EXPECT_EQ(particles.m_particles.size(), 10u);
  particles.beginStep();
  EXPECT_EQ(particles.lastStep().particles, 10u);
}

TEST(ParticleSet, AFixedNumberOfParticlesStays) {
  FilterConfiguration c = adaptive();
  c.filter.particles = 12;
  ParticleSet particles(c);
  particles.reset({});
  RandomStream random(1, 0, 0);
  const PreparedScan scan = prepared(room(), {}, random);
  particles.beginStep();
  particles.updateMaps(scan);
  for (int i = 0; i < 3; ++i) {
    particles.beginStep();
    particles.sampleAndWeigh({2, 0, 0}, scan);
    particles.resampleIfDue();
    EXPECT_EQ(particles.m_particles.size(), 12u);
  }
}

/// The laser is covered for two sides of the square: the particles spread. Then it sees the mapped room
/// again.
TEST(HybridFilter, HasMoreParticlesWhileItSeesNothing) {
  FilterConfiguration c = roomConfiguration();
  c.filter.particles = 0, c.filter.minParticles = 10, c.filter.maxParticles = 40;
  c.motion.distance.varianceD = c.motion.drift.varianceD = 0.01;
  HybridFilter filter(c);
  const std::vector<DriveStep> steps = drive(12);
  const size_t side = steps.size() / 12;
  size_t covered = 0;
  for (size_t i = 0; i < steps.size(); ++i) {
    auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>(steps[i].scan);
    if (i / side == 4 || i / side == 5)
      for (size_t beam = 0; beam < scan->getScanSize(); ++beam) scan->setScanRangeValidity(beam, false);
    filter.process(steps[i].odometry, {scan});
    const size_t particles = filter.lastStep().particles;
    EXPECT_GE(particles, 10u);
    EXPECT_LE(particles, 40u);
    if (i / side <= 5) covered = particles;
  }
  EXPECT_GT(covered, 25u);
  EXPECT_LT(filter.lastStep().particles, 25u);
}

}  // namespace
}  // namespace hybrid_slam
