#include <gtest/gtest.h>

#include "slam/lines/LineExtractor.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

/// Lines by splitting and by split-and-merge.
std::pair<std::vector<LineSegment>, std::vector<LineSegment>> splitAndMerged(const LaserScan& scan) {
  LineExtractionOptions options;
  options.method = &kSplitExtractor;
  const auto split = extractLines(scan, options);
  options.method = &kSplitMergeExtractor;
  return {split, extractLines(scan, options)};
}

TEST(SplitMerge, JoinsAWallThatANoisyPointHasSplit) {
  RandomStream random(17, 0, 0);
  for (int i = 0; i < 100; ++i)
    for (const double offset : {-0.2, 0.2}) {
      LaserScan scan = test::scanOf({{{3, -3}, {3, 3}}}, {}, {}, 541, 270 * kDegree, 0.01, random);
      scan.beams[270].range += offset;  // straight ahead
      const auto [split, merged] = splitAndMerged(scan);
      ASSERT_EQ(split.size(), 2u);
      EXPECT_LT(split[0].length, 3.1);
      EXPECT_LT(split[1].length, 3.1);
      ASSERT_EQ(merged.size(), 1u);
      EXPECT_NEAR(merged[0].length, 6, 0.15);
      EXPECT_NEAR(merged[0].rho, 3, 0.01);
      EXPECT_LT(test::angleBetween(merged[0].theta, 0), 0.3 * kDegree);
    }
}

TEST(SplitMerge, FindsAWallWhosePiecesAreTooShort) {
  RandomStream random(18, 0, 0);
  LaserScan scan = test::scanOf({{{3, -0.8}, {3, 0.8}}}, {}, {}, 541, 270 * kDegree, 0.01, random);
  scan.beams[270].range -= 0.2;
  const auto [split, merged] = splitAndMerged(scan);
  EXPECT_TRUE(split.empty());
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(merged[0].length, 1.6, 0.15);
}

/// The pillar has too few points for a piece between those of the wall.
TEST(SplitMerge, KeepsAWallDividedByANarrowPillar) {
  RandomStream random(19, 0, 0);
  test::Walls walls = test::polygon({{4.7, -0.1}, {5, -0.1}, {5, 0.1}, {4.7, 0.1}});
  walls.push_back({{5, -3}, {5, 3}});
  for (int i = 0; i < 100; ++i) {
    const auto merged = splitAndMerged(test::scanOf(walls, {}, {}, 541, 270 * kDegree, 0.01, random)).second;
    ASSERT_EQ(merged.size(), 2u);
    EXPECT_LT(merged[0].length, 3);
    EXPECT_LT(merged[1].length, 3);
  }
}

/// The few points of the step hardly change the RMS distance from the wall.
TEST(SplitMerge, LeavesOutAStepAtTheEndOfAWall) {
  RandomStream random(21, 0, 0);
  const test::Walls walls{{{3, -3}, {3, 3}}, {{3.14, 3}, {3.14, 3.6}}};
  for (int i = 0; i < 100; ++i) {
    const auto merged = splitAndMerged(test::scanOf(walls, {}, {}, 541, 270 * kDegree, 0.003, random)).second;
    ASSERT_EQ(merged.size(), 1u);
    EXPECT_LT(merged[0].length, 6.05);
    EXPECT_GT(merged[0].length, 5.7);  // splitting cuts off a few points
    EXPECT_NEAR(merged[0].rho, 3, 0.005);
  }
}

/// All points of both walls are within split_distance of one line, but its RMS distance exceeds max_rms.
TEST(SplitMerge, KeepsAnObtuseCorner) {
  RandomStream random(20, 0, 0);
  const test::Walls walls{{{3, -3}, {3.16, 0}}, {{3.16, 0}, {3, 3}}};
  for (int i = 0; i < 100; ++i) {
    const auto merged = splitAndMerged(test::scanOf(walls, {}, {}, 541, 270 * kDegree, 0.01, random)).second;
    ASSERT_EQ(merged.size(), 2u);
    EXPECT_GT(test::angleBetween(merged[0].theta, merged[1].theta), 5 * kDegree);
  }
}

}  // namespace
}  // namespace hybrid_slam
