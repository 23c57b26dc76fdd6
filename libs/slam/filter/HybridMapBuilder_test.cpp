#include "slam/filter/HybridMapBuilder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/poses/CPose3DPDFParticles.h>

#include "base/Errors.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::obs::CActionCollection;
using mrpt::obs::CSensoryFrame;
using Proposal = ParticleFilterOptions::Proposal;

/// Passes an odometry increment without a scan.
void feedOdometry(HybridMapBuilder& builder, const TPose2D& odometry) {
  auto action = test::actionOf(odometry);
  CSensoryFrame nothing;
  builder.processActionObservation(action, nothing);
}

TPose2D meanPose(const HybridMapBuilder& builder) {
  return TPose2D(builder.getCurrentPoseEstimation()->getMeanVal().asTPose());
}

void expectPose(const TPose2D& pose, const TPose2D& expected, double tolerance) {
  EXPECT_NEAR(pose.x, expected.x, tolerance);
  EXPECT_NEAR(pose.y, expected.y, tolerance);
  EXPECT_NEAR(std::remainder(pose.phi - expected.phi, 2 * M_PI), 0, tolerance);
}

/// Returns whether a cell within 10 cm of the point is more likely occupied than not.
bool isWallAt(const mrpt::maps::COccupancyGridMap2D& grid, double x, double y) {
  for (double dx = -0.1; dx <= 0.1; dx += 0.05)
    for (double dy = -0.1; dy <= 0.1; dy += 0.05)
      if (grid.getPos(static_cast<float>(x + dx), static_cast<float>(y + dy)) < 0.5) return true;
  return false;
}

TEST(HybridMapBuilder, StartsEmptyAtTheOrigin) {
  HybridMapBuilder builder(test::roomConfiguration());
  EXPECT_EQ(builder.updates(), 0u);
  EXPECT_TRUE(builder.bestPath().empty());
  EXPECT_TRUE(builder.bestLines().empty());
  EXPECT_EQ(builder.particlePoses().size(), 20u);
  expectPose(meanPose(builder), {}, 1e-9);
}

TEST(HybridMapBuilder, TheFirstScanIsInsertedWhereTheOdometrySays) {
  HybridMapBuilder builder(test::roomConfiguration());
  RandomStream random(1, 0, 0);
  feedOdometry(builder, {0.1, 0, 0});
  feed(builder, {{0.1, 0, 0.2}, {}, test::roomScan({0.2, 0, 0.2}, random)});
  ASSERT_EQ(builder.updates(), 1u);
  expectPose(builder.bestPath().at(0), {0.2, 0, 0.2}, 1e-12);
  EXPECT_TRUE(isWallAt(builder.bestGrid(), 8, 0));
  EXPECT_TRUE(isWallAt(builder.bestGrid(), 2, 5));
  EXPECT_GT(builder.bestGrid().getPos(3.025f, 0.225f), 0.5);  // free in between
  EXPECT_EQ(builder.lastStep().particles, 20u);
  EXPECT_EQ(builder.lastStep().ess, 1);
  EXPECT_EQ(builder.lastStep().resampled, false);
}

TEST(HybridMapBuilder, UpdatesWhenTheRobotHasMovedFarEnough) {
  FilterConfiguration c = test::roomConfiguration();
  c.filter.updateDistance = 0.5;
  c.filter.updateAngle = 90 * kDegree;
  HybridMapBuilder builder(c);
  RandomStream random(1, 0, 0);
  std::vector<size_t> updates;
  for (int i = 0; i <= 8; ++i) {
    feed(builder, {{i == 0 ? 0 : 0.125, 0, 0}, {}, test::roomScan({0.125 * i, 0, 0}, random)});
    updates.push_back(builder.updates());
  }
  EXPECT_EQ(updates, (std::vector<size_t>{1, 1, 1, 1, 2, 2, 2, 2, 3}));
}

TEST(HybridMapBuilder, UpdatesWhenTheRobotHasTurnedFarEnough) {
  FilterConfiguration c = test::roomConfiguration();
  c.filter.updateDistance = 10;
  c.filter.updateAngle = 0.5;
  for (const double turn : {0.125, -0.125}) {
    HybridMapBuilder builder(c);
    RandomStream random(1, 0, 0);
    std::vector<size_t> updates;
    for (int i = 0; i <= 8; ++i) {
      feed(builder, {{0, 0, i == 0 ? 0 : turn}, {}, test::roomScan({0, 0, i * turn}, random)});
      updates.push_back(builder.updates());
    }
    EXPECT_EQ(updates, (std::vector<size_t>{1, 1, 1, 1, 2, 2, 2, 2, 3}));
  }
}

TEST(HybridMapBuilder, WithoutAScanItOnlyAccumulatesOdometry) {
  HybridMapBuilder builder(test::roomConfiguration());
  RandomStream random(1, 0, 0);
  feed(builder, {{}, {}, test::roomScan({}, random)});
  for (int i = 0; i < 10; ++i) feedOdometry(builder, {0.1, 0, 0});
  EXPECT_EQ(builder.updates(), 1u);
  expectPose(meanPose(builder), {1, 0, 0}, 1e-9);
  feed(builder, {{}, {}, test::roomScan({1, 0, 0}, random)});
  EXPECT_EQ(builder.updates(), 2u);
  expectPose(meanPose(builder), {1, 0, 0}, 0.1);
}

TEST(HybridMapBuilder, AnActionWithoutOdometryIsAnError) {
  HybridMapBuilder builder(test::roomConfiguration());
  CActionCollection nothing;
  CSensoryFrame observations;
  EXPECT_THROW(builder.processActionObservation(nothing, observations), InputError);
}

/// All beams are invalid: nothing can be weighed, so only the poses may change.
TEST(HybridMapBuilder, AnEmptyScanLeavesTheWeightsEqual) {
  HybridMapBuilder builder(test::roomConfiguration());
  RandomStream random(1, 0, 0);
  auto scan = test::roomScan({}, random);
  feed(builder, {{}, {}, scan});
  for (size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRangeValidity(i, false);
  feed(builder, {{0.5, 0, 0}, {}, scan});
  ASSERT_EQ(builder.updates(), 2u);
  EXPECT_NEAR(builder.lastStep().ess, 1, 1e-12);
  EXPECT_EQ(builder.lastStep().resampled, false);
  for (const auto& particle : builder.particlePoses()) EXPECT_EQ(particle.logWeight, 0);
  feed(builder, {{0.5, 0, 0}, {}, mrpt::obs::CObservation2DRangeScan()});  // no beams at all
  EXPECT_EQ(builder.updates(), 3u);
  for (const auto& particle : builder.particlePoses()) EXPECT_EQ(particle.logWeight, 0);
}

/// Two builders with one seed draw the same particles; the one that never resamples shows their weights.
TEST(HybridMapBuilder, TheBestParticleIsTheOneWithTheGreatestWeightBeforeResampling) {
  FilterConfiguration never = test::roomConfiguration(), always = test::roomConfiguration();
  never.filter.essThreshold = 0;
  always.filter.essThreshold = 1;
  HybridMapBuilder weighing(never), resampling(always);
  RandomStream random(1, 0, 0);
  for (const test::DriveStep& step :
       {test::DriveStep{{}, {}, test::roomScan({}, random)},
        test::DriveStep{{0.5, 0, 0.1}, {}, test::roomScan({0.5, 0, 0.05}, random)}})
    feed(weighing, step), feed(resampling, step);

  const auto weighed = weighing.particlePoses();
  const auto best = std::max_element(weighed.begin(), weighed.end(),
                                     [](const auto& a, const auto& b) { return a.logWeight < b.logWeight; });
  EXPECT_EQ(weighing.bestPath().back(), best->pose);
  EXPECT_EQ(resampling.bestPath().back(), best->pose);
  EXPECT_EQ(weighing.lastStep().resampled, false);
  EXPECT_EQ(resampling.lastStep().resampled, true);
  EXPECT_EQ(weighing.lastStep().ess, resampling.lastStep().ess);
  EXPECT_LT(weighing.lastStep().ess, 1);
  EXPECT_NE(weighed.front().logWeight, weighed.back().logWeight);
  for (const auto& particle : resampling.particlePoses())
    EXPECT_EQ(particle.logWeight, 0);  // MRPT does not reset them: see ParticleSet::performSubstitution
}

TEST(HybridMapBuilder, AScanThatFitsNoParticleLeavesFiniteWeights) {
  // With the weight of 1000 beams, no outliers and a scan of another place, all weights underflow.
  FilterConfiguration c = test::roomConfiguration();
  c.gridWeight.exponent = 1000;
  c.gridWeight.outlier = 1e-6;
  HybridMapBuilder builder(c);
  RandomStream random(1, 0, 0);
  feed(builder, {{}, {}, test::roomScan({}, random)});
  feed(builder, {{0.5, 0, 0}, {}, test::roomScan({4, 3, 2}, random)});
  ASSERT_EQ(builder.updates(), 2u);
  EXPECT_GT(builder.lastStep().ess, 0);
  EXPECT_LE(builder.lastStep().ess, 1);
}

TEST(HybridMapBuilder, GivesTheViewsOfMrptsOwnBuilder) {
  HybridMapBuilder builder(test::roomConfiguration());
  const auto steps = test::drive(1);
  const test::Replayed replayed = feed(builder, builder, steps);
  mrpt::slam::CMetricMapBuilder& face = builder;

  EXPECT_EQ(face.getCurrentlyBuiltMapSize(), replayed.truth.size());
  mrpt::maps::CSimpleMap scans;
  face.getCurrentlyBuiltMap(scans);
  const auto path = builder.bestPath();
  ASSERT_EQ(scans.size(), path.size());
  for (size_t i = 0; i < path.size(); ++i) {
    const auto& keyframe = scans.begin()[i];
    expectPose(TPose2D(keyframe.pose->getMeanVal().asTPose()), path[i], 1e-9);
    EXPECT_TRUE(keyframe.sf->getObservationByClass<mrpt::obs::CObservation2DRangeScan>());
  }

  const auto& maps = asReference(face.getCurrentlyBuiltMetricMap());
  const auto grid = maps.mapByClass<mrpt::maps::COccupancyGridMap2D>();
  ASSERT_TRUE(grid);
  EXPECT_TRUE(isWallAt(*grid, 8, 0));
  EXPECT_FALSE(isWallAt(*grid, 5, 0));

  std::deque<mrpt::math::TPose3D> mostLikely;
  builder.getCurrentMostLikelyPath(mostLikely);
  ASSERT_EQ(mostLikely.size(), path.size());
  EXPECT_EQ(TPose2D(mostLikely.back()), path.back());

  const auto pdf =
      std::dynamic_pointer_cast<mrpt::poses::CPose3DPDFParticles>(face.getCurrentPoseEstimation());
  ASSERT_TRUE(pdf);
  EXPECT_EQ(pdf->m_particles.size(), 20u);
  expectPose(meanPose(builder), steps.back().truth, 0.05);
}

TEST(HybridMapBuilder, KeepsNoScansIfSwitchedOff) {
  HybridMapBuilder builder(test::roomConfiguration());
  builder.rememberScans(false);
  feed(builder, builder, test::drive(1));
  mrpt::maps::CSimpleMap scans;
  builder.getCurrentlyBuiltMap(scans);
  EXPECT_EQ(scans.size(), 0u);
}

TEST(HybridMapBuilder, KeptScansKeepTheirPoses) {
  HybridMapBuilder builder(test::roomConfiguration());
  const auto steps = test::drive(1);
  const size_t third = steps.size() / 3;
  std::vector<size_t> remembered;  // updates
  for (size_t i = 0; i < steps.size(); ++i) {
    const bool isKept = i / third == 1;
    builder.rememberScans(isKept);
    const size_t before = builder.updates();
    feed(builder, steps[i]);
    if (isKept && builder.updates() > before) remembered.push_back(before);
  }
  mrpt::maps::CSimpleMap scans;
  builder.getCurrentlyBuiltMap(scans);
  ASSERT_GT(remembered.size(), 1u);
  ASSERT_GT(remembered.front(), 0u);
  ASSERT_EQ(scans.size(), remembered.size());
  EXPECT_EQ(builder.getCurrentlyBuiltMapSize(), remembered.size());
  const auto path = builder.bestPath();
  for (size_t i = 0; i < scans.size(); ++i) {
    const auto& pose = *scans.begin()[i].pose;
    expectPose(TPose2D(pose.getMeanVal().asTPose()), path.at(remembered[i]), 1e-9);
  }
}

TEST(HybridMapBuilder, InitializeRestarts) {
  HybridMapBuilder builder(test::roomConfiguration()), fresh(test::roomConfiguration());
  const auto steps = test::drive(1);
  feed(builder, builder, steps);
  const mrpt::poses::CPosePDFGaussian start(mrpt::poses::CPose2D(1, 2, 0.5));
  builder.initialize({}, &start);
  EXPECT_EQ(builder.updates(), 0u);
  expectPose(meanPose(builder), {1, 2, 0.5}, 1e-9);
  builder.initialize();
  expectPose(meanPose(builder), {}, 1e-9);
  feed(builder, builder, steps);
  feed(fresh, fresh, steps);
  EXPECT_EQ(builder.bestPath(), fresh.bestPath());  // nothing of the first run is left
}

/// Like MRPT's builder: the new map holds the scans of the old one.
TEST(HybridMapBuilder, ContinuesFromAMapOfScans) {
  const auto steps = test::drive(4);
  HybridMapBuilder first(test::roomConfiguration());
  feed(first, first, {steps.begin(), steps.begin() + 44});
  mrpt::maps::CSimpleMap old;
  first.getCurrentlyBuiltMap(old);

  HybridMapBuilder second(test::roomConfiguration());
  second.initialize(old);
  EXPECT_EQ(second.getCurrentlyBuiltMapSize(), old.size());
  mrpt::maps::CSimpleMap same;
  second.getCurrentlyBuiltMap(same);
  EXPECT_EQ(same.size(), old.size());
  expectPose(meanPose(second), first.bestPath().back(), 1e-9);
  EXPECT_TRUE(second.bestGrid().getRawMap() ==
              first.bestGrid().getRawMap());  // the same scans, the same poses
  EXPECT_EQ(second.bestLines().size(), first.bestLines().size());

  // The robot has moved on since the last scan of the old map.
  const mrpt::poses::CPosePDFGaussian start(mrpt::poses::CPose2D(meanPose(first)));
  second.initialize(old, &start);
  expectPose(meanPose(second), meanPose(first), 1e-9);
  feed(second, second, {steps.begin() + 44, steps.end()});
  mrpt::maps::CSimpleMap whole;
  second.getCurrentlyBuiltMap(whole);
  EXPECT_EQ(whole.size(), old.size() + second.updates());
  EXPECT_EQ(second.getCurrentlyBuiltMapSize(), whole.size());
  EXPECT_EQ(second.bestPath().size(), second.updates());
  const auto& last = *whole.rbegin()->pose;
  expectPose(TPose2D(last.getMeanVal().asTPose()), second.bestPath().back(), 1e-9);
  // Back at the start, in the first map's frame; odometry alone has failed by then.
  expectPose(second.bestPath().back(), steps.back().truth, 0.2);
}

}  // namespace
}  // namespace hybrid_slam
