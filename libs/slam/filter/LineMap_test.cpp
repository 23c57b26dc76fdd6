// HybridFilter with particles that hold lines alone.
#include <gtest/gtest.h>

#include "slam/filter/HybridFilter.h"
#include "testing/FilteredDrive.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

FilterConfiguration lineMap(int threads = 1) {
  FilterConfiguration c;
  c.useGrid = false;
  c.filter.particles = 60;
  c.filter.threads = threads;
  return c;
}

TEST(LineMap, CorrectsTheOdometryAroundARing) {
  HybridFilter filter(lineMap());
  const FilteredDrive mapped = filtered(filter, ringDrive(0.2 * kDegree));
  EXPECT_GT(rms(mapped.odometry, mapped.truth), 2);
  EXPECT_LT(rms(mapped.path, mapped.truth), 0.3);
  EXPECT_GT(filter.bestLines().size(), 8u);
  EXPECT_GT(filter.lastStep().gridWeight.value(), 0.1);
  EXPECT_GT(filter.lastStep().linesSeen, 0);
  EXPECT_FALSE(filter.lastStep().degeneracy);
  // The grid is that of the scans: the corridor is free, the wall ahead of the start occupied.
  const auto grid = filter.bestGrid();
  EXPECT_GT(grid.getPos(10, 0), 0.6);
  EXPECT_GT(grid.getXMax() - grid.getXMin(), 36);
}

TEST(LineMap, SamePathForAnyNumberOfThreads) {
  std::vector<DrivenPose> drive = ringDrive(0.2 * kDegree);
  drive.resize(100);
  HybridFilter one(lineMap(1)), three(lineMap(3));
  EXPECT_EQ(filtered(one, drive).path, filtered(three, drive).path);  // bit-identical
  EXPECT_TRUE(one.bestGrid().getRawMap() == three.bestGrid().getRawMap());
}

TEST(LineMap, WithoutLinesTheMotionModelAlone) {
  std::vector<DrivenPose> drive = ringDrive(0);
  drive.resize(60);
  for (DrivenPose& driven : drive)
    for (Beam& beam : driven.scans[0].beams) beam.valid = false;
  HybridFilter filter(lineMap());
  const FilteredDrive mapped = filtered(filter, drive);
  EXPECT_TRUE(filter.bestLines().empty());
  EXPECT_LT(rms(mapped.path, mapped.odometry), 3);
  EXPECT_DOUBLE_EQ(filter.lastStep().ess, 1);
}

}  // namespace
}  // namespace hybrid_slam
