#include <gtest/gtest.h>

#include "slam/filter/HybridFilter.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// The motion model trusts an odometry whose heading drifts: no particle closes the loop.
FilterConfiguration trustingConfiguration() {
  FilterConfiguration c;
  c.useLines = false;
  c.filter.proposal = ParticleFilterOptions::Proposal::standard;
  c.filter.particles = 4;
  c.filter.updateDistance = 0.2, c.filter.updateAngle = 10 * kDegree;
  for (MotionTerm* term : {&c.motion.distance, &c.motion.drift, &c.motion.turn})
    term->varianceD = term->varianceT = 1e-8, term->meanStd = 0;
  c.motion.minStdXY = c.motion.minStdPhi = 1e-4;
  return c;
}

struct Filtered {
  std::vector<TPose2D> path;
  std::vector<size_t> closures;  ///< updates
  mrpt::maps::COccupancyGridMap2D grid;
};

Filtered filtered(const std::vector<DrivenPose>& drive, const FilterConfiguration& c) {
  HybridFilter filter(c);
  Filtered result;
  for (const DrivenPose& step : drive) {
    const size_t before = filter.updates();
    filter.process(step.motion, observed(step.scans[0]));
    if (filter.updates() > before && filter.lastStep().loop) result.closures.push_back(before);
  }
  result.path = filter.bestPath();
  result.grid = filter.bestGrid();
  return result;
}

double endError(const Filtered& result, const std::vector<DrivenPose>& drive) {
  const TPose2D &end = result.path.back(), &truth = drive.back().truth;
  return std::hypot(end.x - truth.x, end.y - truth.y);
}

TEST(LoopClosing, TheFilterGoesOnFromTheCorrectedPathAndMap) {
  const auto drive = ringDrive(0.03 * kDegree);
  FilterConfiguration c = trustingConfiguration();
  const Filtered on = filtered(drive, c);
  c.loopClosing.enabled = false;
  const Filtered off = filtered(drive, c);
  EXPECT_TRUE(off.closures.empty());
  EXPECT_FALSE(on.closures.empty());
  EXPECT_EQ(on.path.size(), off.path.size());
  EXPECT_GT(endError(off, drive), 1);
  EXPECT_LT(endError(on, drive), 0.3 * endError(off, drive));
  EXPECT_LT(std::hypot(on.path[0].x, on.path[0].y), 1e-9);
}

TEST(LoopClosing, WithoutALoopItChangesNothing) {
  auto drive = ringDrive(0.03 * kDegree);
  drive.resize(drive.size() / 3);
  FilterConfiguration c = trustingConfiguration();
  const Filtered on = filtered(drive, c);
  c.loopClosing.enabled = false;
  EXPECT_EQ(on.path, filtered(drive, c).path);
}

TEST(LoopClosing, IsTheSameForAnyNumberOfThreads) {
  const auto drive = ringDrive(0.03 * kDegree);
  FilterConfiguration c = trustingConfiguration();
  const Filtered one = filtered(drive, c);
  c.filter.threads = 3;
  const Filtered three = filtered(drive, c);
  EXPECT_EQ(one.path, three.path);
  EXPECT_EQ(one.closures, three.closures);
  EXPECT_TRUE(one.grid.getRawMap() == three.grid.getRawMap());
}

}  // namespace
}  // namespace hybrid_slam
