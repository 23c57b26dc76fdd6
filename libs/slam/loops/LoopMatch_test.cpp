#include "slam/loops/LoopMatch.h"

#include <gtest/gtest.h>

#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

LocalMap mapAlong(const Walls& walls, const std::vector<TPoint2D>& corners) {
  std::vector<Keyframe> keyframes;
  std::vector<TPose2D> poses;
  for (const DrivenPose& pose : driveAlong(walls, corners, 0)) {
    keyframes.push_back({keyframes.size(), ScanBeams(pose.scans)});
    poses.push_back(pose.truth);
  }
  GridOptions options;
  options.resolution = 0.1;
  return localMap(keyframes, poses, 0, keyframes.size(), options);
}

/// A corridor along x with cupboards every `period` m, its ends out of range.
Walls corridorWithCupboards(double period) {
  Walls walls{{{-1000, -1.5}, {1000, -1.5}}, {{-1000, 1.5}, {1000, 1.5}}};
  for (double x = -50; x < 50; x += period) append(walls, box(x, 1.0, x + 0.6, 1.5));
  return walls;
}

TEST(LoopMatch, FindsAnotherVisitOfAPlaceInTheWindow) {
  const LocalMap older = mapAlong(ring(), {{4, 0}, {12, 0}}), newer = mapAlong(ring(), {{6, 0.4}, {14, 0.2}});
  const TPose2D truth(2, 0.3, 0);  // between the middles, about
  const auto match =
      searchMatch({truth.x + 1.2, truth.y - 0.8, 5 * kDegree}, {2, 10 * kDegree}, newer, older);
  ASSERT_TRUE(match);
  EXPECT_GT(match->agreement.fit, 0.95);
  EXPECT_GT(match->agreement.overlap, 0.6);
  EXPECT_LT(match->second, 0.8);
  EXPECT_NEAR(match->pose.x, truth.x, 0.2);
  EXPECT_NEAR(match->pose.y, truth.y, 0.1);
}

TEST(LoopMatch, TheSameCupboardsAgainAreAmbiguous) {
  const Walls walls = corridorWithCupboards(1.5);
  const LocalMap older = mapAlong(walls, {{0, 0}, {10, 0}}), newer = mapAlong(walls, {{2, 0}, {10, 0}});
  const auto match = searchMatch({1.2, 0, 0}, {2, 5 * kDegree}, newer, older);
  ASSERT_TRUE(match);
  EXPECT_GT(match->second, 0.9);
}

TEST(LoopMatch, AFeaturelessCorridorIsAmbiguous) {
  const Walls walls = corridorWithCupboards(1000);
  const LocalMap older = mapAlong(walls, {{0, 0}, {10, 0}}), newer = mapAlong(walls, {{2, 0}, {10, 0}});
  const auto match = searchMatch({1.2, 0, 0}, {2, 5 * kDegree}, newer, older);
  ASSERT_TRUE(match);
  EXPECT_GT(match->second, 0.9);
  const Eigen::Matrix3d information = informationOf(match->pose, newer, older);
  EXPECT_LT(information(0, 0), 0.1 * information(1, 1));
}

TEST(LoopMatch, AnotherPlaceContradicts) {
  const LocalMap older = mapAlong(ring(), {{4, 0}, {12, 0}}),
                 newer = mapAlong(box(-3, -2.5, 8, 6), {{0, 0}, {5, 0}});
  const auto match = searchMatch({0, 0, 0}, {2, 10 * kDegree}, newer, older);
  EXPECT_TRUE(!match || match->agreement.fit < 0.8 || match->agreement.overlap < 0.5);
}

}  // namespace
}  // namespace hybrid_slam
