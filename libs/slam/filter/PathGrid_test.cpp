#include "slam/filter/PathGrid.h"

#include <gtest/gtest.h>

#include "slam/grid/GridConversion.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

bool isSame(const OccupancyGrid& a, const OccupancyGrid& b) {
  return toMrpt(a).getRawMap() == toMrpt(b).getRawMap();
}

/// The paths grow, change in their newest and in their oldest poses, and become shorter.
TEST(PathGrid, EqualsTheScansInsertedAtOnce) {
  const std::vector<DrivenPose> drive = ringDrive(0);
  std::vector<TPose2D> path;
  std::vector<Scans> scans;
  PathGrid grid{GridOptions()};
  const auto expectRight = [&] {
    OccupancyGrid whole;
    for (size_t i = 0; i < path.size(); ++i)
      whole.insert(ScanBeams(toLaserScans(scans[i], GridOptions().maxRange)), path[i], GridOptions());
    EXPECT_TRUE(isSame(grid.of(path, scans), whole)) << path.size();
    EXPECT_TRUE(isSame(grid.of(path, scans), whole)) << path.size();
  };
  expectRight();
  for (size_t i = 0; i < 140; ++i) {
    path.push_back(drive[i].truth);
    scans.push_back(observed(drive[i].scans[0]));
    if (i % 35 == 3) expectRight();
  }
  path[135].x += 1;
  expectRight();
  path[5].x += 1;
  expectRight();
  path.resize(20), scans.resize(20);
  expectRight();
}

TEST(PathGrid, LeavesOutAPoseWithoutScans) {
  const std::vector<DrivenPose> drive = ringDrive(0);
  PathGrid whole{GridOptions()}, first{GridOptions()};
  const std::vector<TPose2D> path{drive[0].truth, drive[30].truth};
  const std::vector<Scans> scans{observed(drive[0].scans[0])};
  EXPECT_TRUE(isSame(whole.of(path, scans), first.of({path[0]}, scans)));
}

}  // namespace
}  // namespace hybrid_slam
