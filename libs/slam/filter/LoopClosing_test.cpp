#include <gtest/gtest.h>

#include "base/State.h"
#include "slam/filter/HybridFilter.h"
#include "slam/grid/GridConversion.h"
#include "testing/RingDrive.h"
#include "testing/TrustedOdometry.h"

namespace hybrid_slam {
namespace {

using namespace test;

template <class T>
std::string bytesOf(T value) {
  std::string bytes;
  StateWriter out(bytes);
  out(value);
  return bytes;
}

struct Filtered {
  std::vector<TPose2D> path;
  std::vector<size_t> closures;  ///< updates
  mrpt::maps::COccupancyGridMap2D grid;
  std::vector<DatabaseLine> lines;
  std::string map;        ///< bytes of grid and line database
  std::string particles;  ///< bytes of the particles with their weights, now and in the last step
  std::vector<Scans> scans;
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
  result.lines = filter.bestLines();
  result.map = bytesOf(filter.bestMap());
  result.particles = bytesOf(filter.particlePoses()) + bytesOf(filter.lastStep());
  result.scans = filter.updateScans();
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

/// The map that the scans of the updates make along the path.
ScanMap mapAlongThePath(const Filtered& result, const FilterConfiguration& c) {
  std::vector<PosedScans> all;
  for (size_t i = 0; i < result.path.size(); ++i) all.push_back({result.scans.at(i), result.path[i], true});
  return MapMaker(c)(all);
}

// A grid or a database that were not rebuilt would hold walls along the path before its correction.
TEST(LoopClosing, GridAndLinesAreThoseOfTheCorrectedPath) {
  const auto drive = ringDrive(0.03 * kDegree);
  FilterConfiguration c = trustingConfiguration();
  for (const bool useLines : {false, true}) {
    SCOPED_TRACE(useLines);
    c.useLines = useLines;
    const Filtered result = filtered(drive, c);
    ASSERT_FALSE(result.closures.empty());
    ASSERT_EQ(result.scans.size(), result.path.size());
    EXPECT_EQ(result.lines.empty(), !useLines);
    const ScanMap expected = mapAlongThePath(result, c);
    EXPECT_TRUE(result.grid.getRawMap() == toMrpt(expected.grid).getRawMap());
    if (useLines) {  // else the database counts no scans
      EXPECT_TRUE(result.map == bytesOf(expected));
    }
  }
}

void expectTheSame(const std::vector<DrivenPose>& drive, FilterConfiguration c) {
  const Filtered on = filtered(drive, c);
  c.loopClosing.enabled = false;
  const Filtered off = filtered(drive, c);
  EXPECT_TRUE(on.closures.empty());
  EXPECT_EQ(on.path, off.path);
  EXPECT_EQ(on.lines.empty(), !c.useLines);
  EXPECT_TRUE(on.map == off.map);
  EXPECT_TRUE(on.particles == off.particles);
}

TEST(LoopClosing, WithoutALoopItChangesNothing) {
  auto drive = ringDrive(0.03 * kDegree);
  drive.resize(drive.size() / 3);
  expectTheSame(drive, trustingConfiguration());
  FilterConfiguration improved;
  improved.filter.particles = 6;
  expectTheSame(drive, improved);
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
