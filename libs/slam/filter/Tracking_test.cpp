#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "base/Errors.h"
#include "slam/filter/HybridMapBuilder.h"
#include "slam/filter/StockMapBuilder.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::bayes::CParticleFilter;
using Proposal = ParticleFilterOptions::Proposal;

struct Outcome {
  std::vector<TPose2D> path;
  double error, odometryError;
  std::vector<DatabaseLine> lines;
  mrpt::maps::COccupancyGridMap2D grid;
  FilterStep last;
  int resamplings = 0;
};

Outcome run(const FilterConfiguration& configuration, const std::vector<test::DriveStep>& steps) {
  HybridMapBuilder builder(configuration);
  Outcome result;
  test::Replayed replayed;
  TPose2D odometry;
  for (const test::DriveStep& step : steps) {
    const size_t before = builder.updates();
    feed(builder, step);
    odometry = odometry + step.odometry;
    if (builder.updates() == before) continue;
    replayed.truth.push_back(step.truth), replayed.odometry.push_back(odometry);
    result.resamplings += builder.lastStep().resampled.value() ? 1 : 0;
  }
  result.path = builder.bestPath();
  result.error = test::rms(result.path, replayed.truth);
  result.odometryError = test::rms(replayed.odometry, replayed.truth);
  result.lines = builder.bestLines();
  result.grid = builder.bestGrid();
  result.last = builder.lastStep();
  return result;
}

void expectSame(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.path, b.path);  // bit-identical
  EXPECT_TRUE(a.grid.getRawMap() == b.grid.getRawMap());
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (size_t i = 0; i < a.lines.size(); ++i) {
    EXPECT_EQ(a.lines[i].rho, b.lines[i].rho);
    EXPECT_EQ(a.lines[i].theta, b.lines[i].theta);
  }
  EXPECT_EQ(a.last.ess, b.last.ess);
  EXPECT_EQ(a.resamplings, b.resamplings);
}

FilterConfiguration with(Proposal proposal, bool useLines) {
  FilterConfiguration c = test::roomConfiguration();
  c.filter.proposal = proposal;
  c.useLines = useLines;
  return c;
}

class Proposals : public testing::TestWithParam<std::pair<Proposal, bool>> {
 protected:
  FilterConfiguration configuration() const {
    FilterConfiguration c = with(GetParam().first, GetParam().second);
    if (GetParam().first == Proposal::auxiliaryOptimal) {  // weighs each particle some hundred times
      c.filter.particles = 6;
      c.gridWeight.beams = 36;
    }
    return c;
  }
};

TEST_P(Proposals, TracksASquareBetterThanItsOdometry) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    FilterConfiguration c = configuration();
    c.filter.seed = static_cast<int>(seed);
    const Outcome result = run(c, test::drive(8, seed));
    EXPECT_LT(result.error, result.odometryError / 3);
    EXPECT_GT(result.resamplings, 0);
    EXPECT_EQ(result.lines.empty(), !GetParam().second);
  }
}

TEST_P(Proposals, SameSeedSameRunForAnyNumberOfThreads) {
  const auto steps = test::drive(2);
  // So that TBB starts as many threads as requested, even with fewer cores.
  const tbb::global_control manyThreads(tbb::global_control::max_allowed_parallelism, 4);
  FilterConfiguration c = configuration();
  const Outcome one = run(c, steps);
  expectSame(run(c, steps), one);
  for (const int threads : {2, 4}) {
    c.filter.threads = threads;
    expectSame(run(c, steps), one);
  }
}

TEST_P(Proposals, DifferentSeedsGiveDifferentRuns) {
  const auto steps = test::drive(1);
  FilterConfiguration c = configuration();
  const Outcome one = run(c, steps);
  c.filter.seed = 2;
  EXPECT_NE(run(c, steps).path, one.path);
}

std::string nameOf(const testing::TestParamInfo<std::pair<Proposal, bool>>& tested) {
  const auto [proposal, useLines] = tested.param;
  const std::string name = proposal == Proposal::standard            ? "Standard"
                           : proposal == Proposal::improved          ? "Improved"
                           : proposal == Proposal::auxiliaryStandard ? "AuxiliaryStandard"
                                                                     : "AuxiliaryOptimal";
  return name + (useLines ? "" : "WithoutLines");
}

INSTANTIATE_TEST_SUITE_P(All, Proposals,
                         testing::Values(std::pair(Proposal::standard, true),
                                         std::pair(Proposal::standard, false),
                                         std::pair(Proposal::improved, true),
                                         std::pair(Proposal::improved, false),
                                         std::pair(Proposal::auxiliaryStandard, true),
                                         std::pair(Proposal::auxiliaryOptimal, true)),
                         nameOf);

TEST(Tracking, TheImprovedProposalTracksBetterThanTheStandardOne) {
  for (const bool useLines : {true, false}) {
    double improved = 0, standard = 0;
    for (uint64_t seed = 1; seed <= 3; ++seed)
      for (auto [proposal, sum] :
           {std::pair(Proposal::improved, &improved), std::pair(Proposal::standard, &standard)}) {
        FilterConfiguration c = with(proposal, useLines);
        c.filter.seed = static_cast<int>(seed);
        *sum += run(c, test::drive(8, seed)).error;
      }
    EXPECT_LT(improved, standard) << useLines;
  }
}

/// The map of one scan is faint, and even a good match fits it badly; it must still be used.
TEST(Tracking, TheImprovedProposalMatchesFromTheSecondScanOn) {
  FilterConfiguration c = with(Proposal::improved, true);
  HybridMapBuilder builder(c);
  const auto steps = test::drive(1);
  for (const test::DriveStep& step : steps) {
    feed(builder, step);
    if (builder.updates() > 1) {
      EXPECT_GT(builder.lastStep().gridWeight.value(), 1.5 * c.improved.minFit);
    }
  }
}

/// The odometry reports 30 deg too much in the middle of a side of the square.
std::vector<test::DriveStep> driveWithSlip() {
  auto steps = test::drive(8);
  steps[30].odometry.phi += 30 * kDegree;
  return steps;
}

TEST(Tracking, TheImprovedProposalSurvivesASlip) {
  for (const bool useLines : {true, false}) {
    HybridMapBuilder builder(with(Proposal::improved, useLines));
    const auto steps = driveWithSlip();
    std::vector<TPose2D> truth;
    std::vector<size_t> slips;
    for (size_t i = 0; i < steps.size(); ++i) {
      const size_t before = builder.updates();
      feed(builder, steps[i]);
      if (builder.updates() == before) continue;
      truth.push_back(steps[i].truth);
      if (builder.lastStep().slipped.value_or(false)) slips.push_back(i);
    }
    EXPECT_EQ(slips, std::vector<size_t>{30}) << useLines;
    EXPECT_LT(test::rms(builder.bestPath(), truth), 0.05) << useLines;

    FilterConfiguration blind = with(Proposal::improved, useLines);
    blind.improved.slipDistance = 0;
    EXPECT_GT(run(blind, steps).error, 0.5) << useLines;  // without the search the run fails
  }
}

TEST(Tracking, AReinitialisedFilterRepeatsTheRun) {
  for (const auto proposal : {Proposal::standard, Proposal::improved}) {
    HybridMapBuilder builder(with(proposal, true));
    const auto steps = driveWithSlip();
    for (const test::DriveStep& step : steps) feed(builder, step);
    const auto path = builder.bestPath();
    builder.initialize();
    for (const test::DriveStep& step : steps) feed(builder, step);
    EXPECT_EQ(builder.bestPath(), path);
  }
}

TEST(Tracking, LinesMakeADifference) {
  const auto steps = test::drive(2);
  const Outcome hybrid = run(with(Proposal::standard, true), steps);
  const Outcome general = run(with(Proposal::standard, false), steps);
  EXPECT_NE(hybrid.path, general.path);
  EXPECT_FALSE(hybrid.lines.empty());
  EXPECT_TRUE(hybrid.last.lineWeight);
  EXPECT_GT(hybrid.last.linesSeen, 0);
  EXPECT_GT(hybrid.last.linesMatched, 0);
  EXPECT_TRUE(general.lines.empty());
  EXPECT_FALSE(general.last.lineWeight);
  EXPECT_EQ(general.last.linesSeen, 0);
}

TEST(Tracking, EveryResamplingSchemeTracks) {
  for (const auto scheme : {CParticleFilter::prMultinomial, CParticleFilter::prResidual,
                            CParticleFilter::prStratified, CParticleFilter::prSystematic}) {
    FilterConfiguration c = test::roomConfiguration();
    c.filter.resampling = scheme;
    const Outcome result = run(c, test::drive(8));
    EXPECT_LT(result.error, result.odometryError / 2);
    EXPECT_GT(result.resamplings, 0);
  }
}

TEST(Tracking, MrptsLikelihoodsWorkInSeveralThreads) {
  const auto steps = test::drive(1);
  const tbb::global_control manyThreads(tbb::global_control::max_allowed_parallelism, 4);
  for (const auto method : {GridWeightOptions::Method::likelihoodField, GridWeightOptions::Method::rayTracing,
                            GridWeightOptions::Method::consensus}) {
    FilterConfiguration c = test::roomConfiguration();
    c.gridWeight.method = method;
    c.grid.wallGap = 0;  // as the paper has it; ray tracing is worse with it
    const Outcome one = run(c, steps);
    c.filter.threads = 4;
    expectSame(run(c, steps), one);
    EXPECT_LT(one.error, 0.8 * one.odometryError);
  }
}

/// A robot that veers by 6 deg/m, which the motion model's variances (1 deg in a step of 0.25 m) would have
/// to absorb in every step.
TEST(Tracking, TheStandardProposalLearnsASystematicError) {
  std::vector<test::DriveStep> steps = test::drive(6);
  for (test::DriveStep& step : steps) step.odometry.phi -= 6 * kDegree * step.odometry.x;
  double learnt = 0, notLearnt = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    FilterConfiguration c = test::roomConfiguration();
    c.filter.seed = seed;
    c.motion.turn.meanStd = 0.05;
    learnt += run(c, steps).error;
    for (MotionTerm* term : {&c.motion.distance, &c.motion.drift, &c.motion.turn}) term->meanStd = 0;
    notLearnt += run(c, steps).error;
  }
  EXPECT_LT(learnt, 0.7 * notLearnt);  // 0.49
}

TEST(Tracking, ResidualResamplingOfTheAuxiliaryFiltersIsAnError) {
  for (const auto proposal : {Proposal::auxiliaryStandard, Proposal::auxiliaryOptimal}) {
    FilterConfiguration c = with(proposal, true);
    c.filter.resampling = CParticleFilter::prResidual;
    EXPECT_THROW(HybridMapBuilder{c}, InputError);
  }
}

TEST(Tracking, ARangeOfTooManyCellsIsAnError) {
  FilterConfiguration c = test::roomConfiguration();
  c.grid.maxRange = 200, c.grid.resolution = 0.02;
  EXPECT_NO_THROW(HybridMapBuilder{c});
  c.grid.resolution = 0.01;
  EXPECT_THROW(HybridMapBuilder{c}, InputError);
  c.grid.resolution = 0.02;
  c.gridWeight.method = GridWeightOptions::Method::likelihoodField;
  EXPECT_THROW(HybridMapBuilder{c}, InputError);
}

/// Without resampling every particle must continue from its pose. MRPT's auxiliary filters give a badly
/// fitting particle the pose of another one, but not its map and path.
TEST(Tracking, AnAuxiliaryFilterLeavesEachParticleItsOwnPath) {
  FilterConfiguration c = with(Proposal::auxiliaryStandard, true);
  c.filter.essThreshold = 0;
  c.gridWeight.exponent = 1000;
  HybridMapBuilder builder(c);
  RandomStream random(1, 0, 0);
  feed(builder, {{}, {}, test::roomScan({}, random)});
  feed(builder, {{5, 0, 0}, {}, test::roomScan({5, 0, 0}, random)});  // half a metre apart afterwards
  const auto before = builder.particlePoses();
  feed(builder, {{0.3, 0, 0}, {}, test::roomScan({5.3, 0, 0}, random)});
  const auto after = builder.particlePoses();
  const auto model = toMrpt(c.motion).gaussianModel;
  const double sigma = model.minStdXY + 0.3 * model.a1;
  for (size_t i = 0; i < before.size(); ++i) {
    const TPose2D expected = before[i].pose + TPose2D(0.3, 0, 0);
    EXPECT_LT(std::hypot(after[i].pose.x - expected.x, after[i].pose.y - expected.y), 5 * sigma) << i;
  }
}

/// Residual resampling gives each particle n w copies on average (see Resampling_test).
TEST(Tracking, TheFiltersResidualSchemeIsNotBiased) {
  // Four particles at x = 0..3 with the weights of the pitfall in Resampling_test.
  FilterConfiguration c = test::roomConfiguration();
  c.filter.particles = 4;
  c.filter.resampling = CParticleFilter::prResidual;
  c.filter.essThreshold = 1;
  constexpr int kRepetitions = 4000;
  double firstCopies = 0;
  for (int seed = 1; seed <= kRepetitions; ++seed) {
    c.filter.seed = seed;
    ParticleSet particles(c);
    particles.reset({});
    particles.beginStep();
    for (size_t i = 0; i < 4; ++i) {
      particles.m_particles[i].d->path.push({static_cast<double>(i), 0, 0});
      particles.m_particles[i].log_w = std::log(i < 3 ? 0.125 : 0.625);
    }
    particles.resampleIfDue();
    for (const auto& particle : particles.poses()) {
      firstCopies += particle.pose.x == 0 ? 1 : 0;
      ASSERT_EQ(particle.logWeight, 0);
    }
  }
  // n w = 0.5; two draws of 1/4 each have the variance 3/8.
  EXPECT_NEAR(firstCopies / kRepetitions, 0.5, 5 * std::sqrt(0.375 / kRepetitions));
}

}  // namespace
}  // namespace hybrid_slam
