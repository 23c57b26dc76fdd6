#include "slam/merging/MapMerging.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

using Corners = std::vector<TPoint2D>;

/// The map of a drive, in a rotated frame whose origin is the first pose.
struct Drive {
  MapPart part;
  TPose2D frame;  ///< of the map, in the world
};

/// @param turnPerMetre  error of the path, rad per m
Drive mapAlong(const Walls& walls, const Corners& corners, double heading = 0, double turnPerMetre = 0) {
  Drive drive;
  TPose2D pose;
  std::vector<PosedScans> scans;
  for (const DrivenPose& driven : driveAlong(walls, corners, turnPerMetre)) {
    if (scans.empty())
      drive.frame = driven.truth + TPose2D(0, 0, heading), pose = TPose2D(0, 0, -heading);
    else
      pose = pose + driven.motion;
    scans.push_back({observed(driven.scans[0]), pose, true});
    drive.part.path.push_back(pose);
    drive.part.scans.push_back(scans.back().scans);
  }
  drive.part.map = MapMaker(FilterConfiguration())(scans);
  return drive;
}

MapPart withoutScans(MapPart part) {
  part.scans.clear();
  return part;
}

/// Returns whether there is a wall within a cell of a place.
bool hasWall(const OccupancyGrid& grid, double x, double y) {
  const CellIndex at = grid.cellOf(x, y);
  for (int k = 0; k < 9; ++k)
    if (grid.occupancy({at.x + k % 3 - 1, at.y + k / 3 - 1}) > 0.6) return true;
  return false;
}

void expectNear(const TPose2D& pose, const TPose2D& truth, double distance, double angle) {
  EXPECT_NEAR(pose.x, truth.x, distance);
  EXPECT_NEAR(pose.y, truth.y, distance);
  EXPECT_NEAR(mrpt::math::wrapToPi(pose.phi - truth.phi), 0, angle);
}

const Corners kSouthAndEast{{0, 0}, {31.5, 0}, {31.5, 21}}, kEastAndNorth{{31.5, 0}, {31.5, 21}, {-1.5, 21}};

struct RingParts : testing::Test {
  Drive older = mapAlong(ring(), kSouthAndEast), newer = mapAlong(ring(), kEastAndNorth, 2);
  TPose2D truth = newer.frame - older.frame;
};

TEST_F(RingParts, APlaceIsFoundWithoutAStart) {
  const MapPlacement placement = placementOf(newer.part.map, older.part.map, 1);
  EXPECT_TRUE(placement.isFound());
  EXPECT_GT(placement.agreement.fit, 0.9);
  EXPECT_NEAR(placement.agreement.overlap, 0.5, 0.2);
  EXPECT_GT(placement.patches.size(), 3u);
  expectNear(placement.frame, truth, 0.1, 0.3 * kDegree);
}

TEST_F(RingParts, OrWithoutLines) {
  newer.part.map.lines = LineDatabase();
  const MapPlacement placement = placementOf(newer.part.map, older.part.map, 1);
  EXPECT_TRUE(placement.isFound());
  expectNear(placement.frame, truth, 0.1, 0.3 * kDegree);
}

TEST_F(RingParts, AMapIsFoundInItself) {
  const MapPlacement placement = placementOf(older.part.map, older.part.map, 1);
  EXPECT_TRUE(placement.isFound());
  EXPECT_GT(placement.agreement.overlap, 0.95);
  expectNear(placement.frame, TPose2D(), 0.02, 0.1 * kDegree);
}

TEST_F(RingParts, OneMapOfBothWithTheirScansOrWithout) {
  const MapPlacement placement = placementOf(newer.part.map, older.part.map, 1);
  for (const bool hasOlder : {false, true})
    for (const bool hasNewer : {false, true}) {
      SCOPED_TRACE(2 * hasOlder + hasNewer);
      const MergedMap both =
          merged(hasOlder ? older.part : withoutScans(older.part),
                 hasNewer ? newer.part : withoutScans(newer.part), placement, FilterConfiguration());
      expectNear(both.frame, truth, 0.03, 0.1 * kDegree);
      ASSERT_EQ(both.older.size(), older.part.path.size());
      ASSERT_EQ(both.newer.size(), newer.part.path.size());
      for (size_t i = 0; i < both.newer.size(); i += 20)
        expectNear(both.newer[i], truth + newer.part.path[i], 0.05, 0.5 * kDegree);
      EXPECT_GT(both.map.lines.lines().size(), older.part.map.lines.lines().size());
      EXPECT_LT(both.map.lines.lines().size(),
                older.part.map.lines.lines().size() + newer.part.map.lines.lines().size());
      // The outer walls of both ends, and free space between them.
      EXPECT_TRUE(hasWall(both.map.grid, 15, -1.5));
      EXPECT_TRUE(hasWall(both.map.grid, 15, 22.5));
      EXPECT_LT(both.map.grid.occupancy(both.map.grid.cellOf(15.02, 21)), 0.4);
    }
}

TEST(MapMerging, DriftIsSpreadWhereTheScansAreKnown) {
  const Drive older = mapAlong(ring(), kSouthAndEast),
              newer = mapAlong(ring(), kEastAndNorth, 1, 0.03 * kDegree);
  const MapPlacement placement = placementOf(newer.part.map, older.part.map, 1);
  ASSERT_TRUE(placement.isFound());
  const MergedMap both = merged(older.part, newer.part, placement, FilterConfiguration());
  const std::vector<DrivenPose> truth = driveAlong(ring(), kEastAndNorth, 0);
  for (size_t i = 0; i < truth.size() && truth[i].truth.y < 18; i += 5)
    expectNear(both.newer[i], truth[i].truth - older.frame, 0.15, 1 * kDegree);
}

TEST(MapPlacement, NoOverlap) {
  const Drive older = mapAlong(ring(), {{0, 0}, {20, 0}}),
              newer = mapAlong(box(-3, -2.5, 8, 6), {{0, 0}, {5, 0}, {5, 4}});
  EXPECT_FALSE(placementOf(newer.part.map, older.part.map, 1).isFound());
  EXPECT_FALSE(placementOf(ScanMap(), older.part.map, 1).isFound());
  EXPECT_FALSE(placementOf(older.part.map, ScanMap(), 1).isFound());
}

/// A room with a niche and a cupboard.
Walls roomAt(double x) {
  Walls walls =
      polygon({{x, 0}, {x + 9, 0}, {x + 9, 6}, {x + 5, 6}, {x + 5, 7}, {x + 3, 7}, {x + 3, 6}, {x, 6}});
  append(walls, box(x + 6.5, 0, x + 7.5, 0.6));
  return walls;
}

TEST(MapPlacement, TwoRoomsThatLookAlikeAreAmbiguous) {
  const Corners tour{{2, 2}, {7, 2}, {7, 4}, {2, 4}};
  Corners far = tour;
  for (TPoint2D& corner : far) corner.x += 30;
  std::vector<PosedScans> scans;
  for (const auto& [walls, corners] : {std::pair(roomAt(0), tour), std::pair(roomAt(30), far)})
    for (const DrivenPose& pose : driveAlong(walls, corners, 0))
      scans.push_back({observed(pose.scans[0]), pose.truth, true});
  const ScanMap older = MapMaker(FilterConfiguration())(scans);
  const Drive newer = mapAlong(roomAt(0), tour, 1);
  const MapPlacement placement = placementOf(newer.part.map, older, 1);
  EXPECT_TRUE(placement.hasEvidence());
  EXPECT_TRUE(placement.isAmbiguous());
  EXPECT_GT(placement.second, 0.9);
  EXPECT_FALSE(placement.isFound());
}

}  // namespace
}  // namespace hybrid_slam
