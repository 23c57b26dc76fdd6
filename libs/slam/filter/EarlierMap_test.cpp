// A filter that may be in the map of an earlier run.
#include <gtest/gtest.h>

#include "slam/filter/HybridFilter.h"
#include "testing/FilteredDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// Share of the scans that contradict the map of the whole ring if the robot is `off` (m, rad) from its pose
/// there.
double contradictedShare(const TPose2D& off, size_t first, size_t last) {
  const std::vector<DrivenPose> drive = ringDrive(0);
  GridOptions options;
  options.resolution = RevisitCheck::kResolution;
  OccupancyGrid map(options.resolution);
  for (const DrivenPose& driven : drive) map.insert(ScanBeams(driven.scans), driven.truth, options);
  HybridFilter filter{FilterConfiguration()};
  filter.expectMap();
  filtered(filter, {drive.begin() + first, drive.begin() + last});
  const std::vector<Revisit> compared = filter.comparedWith(map, drive[last - 1].truth + off);
  EXPECT_GT(compared.size(), 20u);
  return static_cast<double>(contradictedOf(compared)) / static_cast<double>(compared.size());
}

TEST(EarlierMap, ScansContradictItAtAWrongPlaceOnly) {
  EXPECT_LT(contradictedShare({}, 40, 100), 0.05);
  EXPECT_GT(contradictedShare({0, 0, M_PI}, 40, 100), 0.5);
  EXPECT_GT(contradictedShare({3, 0, 0}, 100, 190), 0.3);
}

TEST(EarlierMap, TheNewestScansCountNotThoseFromLongAgo) {
  const std::vector<DrivenPose> drive = ringDrive(0);
  FilterConfiguration configuration;
  configuration.grid.resolution = RevisitCheck::kResolution;
  HybridFilter filter(configuration);
  filter.expectMap();
  filtered(filter, {drive.begin(), drive.begin() + 320});
  const auto compared = filter.comparedWith(filter.bestMap().grid, filter.bestPath().back());
  ASSERT_FALSE(compared.empty());
  EXPECT_NEAR(compared.back().distance - compared.front().distance, 50, 1);
}

TEST(EarlierMap, NothingIsComparedBeforeTheFirstScan) {
  HybridFilter filter{FilterConfiguration()};
  filter.expectMap();
  EXPECT_TRUE(filter.comparedWith(OccupancyGrid(), {}).empty());
}

}  // namespace
}  // namespace hybrid_slam
