// HybridFilter with particles that hold lines alone.
#include <gtest/gtest.h>

#include "slam/filter/HybridFilter.h"
#include "slam/grid/GridConversion.h"
#include "testing/RingDrive.h"
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

struct Mapped {
  std::vector<TPose2D> path, truth, odometry;
  std::vector<DatabaseLine> lines;
  mrpt::maps::COccupancyGridMap2D grid;
  FilterStep last;
};

Mapped map(const std::vector<DrivenPose>& drive, const FilterConfiguration& c) {
  HybridFilter filter(c);
  Mapped mapped;
  TPose2D odometry = drive[0].truth;
  for (const DrivenPose& driven : drive) {
    const size_t before = filter.updates();
    filter.process(driven.motion, observed(driven.scans[0]));
    odometry = odometry + driven.motion;
    if (filter.updates() == before) continue;
    mapped.truth.push_back(driven.truth);
    mapped.odometry.push_back(odometry);
  }
  mapped.path = filter.bestPath();
  mapped.lines = filter.bestLines();
  mapped.grid = filter.bestGrid();
  mapped.last = filter.lastStep();
  return mapped;
}

TEST(LineMap, CorrectsTheOdometryAroundARing) {
  const Mapped mapped = map(ringDrive(0.2 * kDegree), lineMap());
  EXPECT_GT(rms(mapped.odometry, mapped.truth), 2);
  EXPECT_LT(rms(mapped.path, mapped.truth), 0.3);
  EXPECT_GT(mapped.lines.size(), 8u);
  EXPECT_GT(mapped.last.gridWeight.value(), 0.1);
  EXPECT_GT(mapped.last.linesSeen, 0);
  EXPECT_FALSE(mapped.last.degeneracy);
  // The grid is that of the scans: the corridor is free, the wall ahead of the start occupied.
  EXPECT_GT(mapped.grid.getPos(10, 0), 0.6);
  EXPECT_GT(mapped.grid.getXMax() - mapped.grid.getXMin(), 36);
}

TEST(LineMap, SamePathForAnyNumberOfThreads) {
  std::vector<DrivenPose> drive = ringDrive(0.2 * kDegree);
  drive.resize(100);
  const Mapped one = map(drive, lineMap(1)), three = map(drive, lineMap(3));
  EXPECT_EQ(one.path, three.path);  // bit-identical
  EXPECT_TRUE(one.grid.getRawMap() == three.grid.getRawMap());
}

TEST(LineMap, WithoutLinesTheMotionModelAlone) {
  std::vector<DrivenPose> drive = ringDrive(0);
  drive.resize(60);
  for (DrivenPose& driven : drive)
    for (Beam& beam : driven.scans[0].beams) beam.valid = false;
  const Mapped mapped = map(drive, lineMap());
  EXPECT_TRUE(mapped.lines.empty());
  EXPECT_LT(rms(mapped.path, mapped.odometry), 3);
  EXPECT_DOUBLE_EQ(mapped.last.ess, 1);
}

}  // namespace
}  // namespace hybrid_slam
