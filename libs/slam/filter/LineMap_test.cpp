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
  float least = 1;  // of the cells within 0.5 m of the wall
  for (float x = 32.5F; x <= 33.5F; x += 0.05F) least = std::min(least, grid.getPos(x, 0));
  EXPECT_LT(least, 0.3);
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

TEST(LineMap, GoesOnInAnEarlierMap) {
  const std::vector<DrivenPose> drive = ringDrive(0);
  const auto part = [&](size_t from, size_t to) {
    return std::vector<DrivenPose>(drive.begin() + from, drive.begin() + to);
  };
  HybridFilter first(lineMap()), second(lineMap());
  filtered(first, part(0, 40));
  filtered(second, part(40, 50));
  second.joinMap(first.bestMap(), drive[49].truth);
  filtered(second, part(50, 60));
  const TPose2D end = second.bestPath().back(), truth = drive[59].truth;
  EXPECT_LT(std::hypot(end.x - truth.x, end.y - truth.y), 0.3);
  EXPECT_EQ(second.updateScans().size(), second.updates());
  EXPECT_GT(second.bestGrid().getPos(static_cast<float>(end.x), static_cast<float>(end.y)), 0.6);
}

TEST(LineMap, ItsShortLinesStayWhenItJoinsAMap) {
  std::vector<DrivenPose> drive = ringDrive(0);
  drive.resize(40);
  HybridFilter filter(lineMap());
  filtered(filter, drive);
  const size_t before = filter.bestLines().size();
  filter.joinMap({OccupancyGrid(lineMap().grid.resolution), LineDatabase()}, filter.bestPath().back());
  EXPECT_EQ(filter.bestLines().size(), before);
}

}  // namespace
}  // namespace hybrid_slam
