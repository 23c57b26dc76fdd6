#include "slam/lines/Segmentation.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// Beams 1 deg apart with these ranges; a range of 0 stands for an invalid beam.
LaserScan scanOfRanges(const std::vector<double>& ranges) {
  LaserScan scan;
  for (size_t i = 0; i < ranges.size(); ++i)
    scan.beams.push_back({static_cast<double>(i) * kDegree, ranges[i], ranges[i] > 0});
  return scan;
}

std::vector<size_t> runSizes(const LaserScan& scan, const SegmentationOptions& options) {
  std::vector<size_t> sizes;
  const SegmentedScan segmented(scan, options);
  for (const PointRange& run : segmented.runs()) sizes.push_back(run.size());
  return sizes;
}

using Sizes = std::vector<size_t>;

SegmentationOptions pairsOnly() {
  SegmentationOptions options;
  options.minPoints = 2;
  options.gapAbsolute = 0.2;
  options.gapRelative = 0;
  return options;
}

TEST(Segmentation, AGapAboveTheThresholdEndsASegment) {
  EXPECT_EQ(runSizes(scanOfRanges({1, 1, 1, 2, 2}), pairsOnly()), (Sizes{3, 2}));
  EXPECT_EQ(runSizes(scanOfRanges({1, 1, 1, 1.19, 1.19}), pairsOnly()), (Sizes{5}));
  EXPECT_EQ(runSizes(scanOfRanges({1, 1, 1, 1.21, 1.21}), pairsOnly()), (Sizes{3, 2}));
}

TEST(Segmentation, TheRelativePartGrowsWithTheNearerRange) {
  auto options = pairsOnly();
  options.gapRelative = 0.1;  // threshold 0.2 + 1.0 m at 10 m
  EXPECT_EQ(runSizes(scanOfRanges({10, 10, 11.1, 11.1}), options), (Sizes{4}));
  EXPECT_EQ(runSizes(scanOfRanges({11.1, 11.1, 10, 10}), options), (Sizes{4}));
  EXPECT_EQ(runSizes(scanOfRanges({10, 10, 11.3, 11.3}), options), (Sizes{2, 2}));
  EXPECT_EQ(runSizes(scanOfRanges({11.3, 11.3, 10, 10}), options), (Sizes{2, 2}));
}

TEST(Segmentation, AnInvalidBeamEndsASegment) {
  EXPECT_EQ(runSizes(scanOfRanges({1, 1, 1, 0, 1, 1}), pairsOnly()), (Sizes{3, 2}));
  EXPECT_EQ(runSizes(scanOfRanges({0, 1, 1, 0, 0, 1, 1, 0}), pairsOnly()), (Sizes{2, 2}));
}

/// The wall behind a laser that looks all round is one run, wherever its first beam points.
TEST(Segmentation, AScanAllRoundHasNoSeam) {
  std::vector<double> ranges(360, 2);
  std::fill(ranges.begin() + 100, ranges.begin() + 160, 3);
  const auto joined = pairsOnly();
  for (size_t turn = 0; turn < 360; turn += 7) {
    std::rotate(ranges.begin(), ranges.begin() + 7, ranges.end());
    auto sizes = runSizes(scanOfRanges(ranges), joined);
    std::sort(sizes.begin(), sizes.end());
    ASSERT_EQ(sizes, (Sizes{60, 300})) << turn;
  }
  EXPECT_EQ(runSizes(scanOfRanges(std::vector<double>(360, 2)), joined), (Sizes{360}));
  EXPECT_EQ(runSizes(scanOfRanges(std::vector<double>(350, 2)), joined), (Sizes{350}));
}

/// The walls of a room without gaps are whole: the seam is moved to a corner.
TEST(Segmentation, TheSeamOfARoomIsMovedToACorner) {
  std::vector<double> ranges;
  for (int i = 0; i < 360; ++i) {
    const double angle = (i + 0.5) * kDegree - M_PI, c = std::abs(std::cos(angle)),
                 s = std::abs(std::sin(angle));
    ranges.push_back(std::min(3 / std::max(c, 1e-9), 2 / std::max(s, 1e-9)));
  }
  SegmentationOptions options;
  const SegmentedScan segmented(scanOfRanges(ranges), options);
  std::vector<PointRange> pieces;
  for (const PointRange& run : segmented.runs()) splitAtCorners(run, options, pieces);
  ASSERT_EQ(pieces.size(), 4u);
  for (const PointRange& piece : pieces) {
    const double length = std::hypot(piece.back().x - piece.front().x, piece.back().y - piece.front().y);
    EXPECT_GT(length, 3.8);
  }
}

TEST(Segmentation, RunsOfTooFewPointsAreDropped) {
  auto options = pairsOnly();
  options.minPoints = 3;
  EXPECT_EQ(runSizes(scanOfRanges({1, 1, 0, 1, 1, 1}), options), (Sizes{3}));
}

TEST(Segmentation, EmptyAndAllInvalidAndOnePoint) {
  EXPECT_TRUE(runSizes(scanOfRanges({}), pairsOnly()).empty());
  EXPECT_TRUE(runSizes(scanOfRanges({0, 0, 0}), pairsOnly()).empty());
  EXPECT_TRUE(runSizes(scanOfRanges({1}), pairsOnly()).empty());
}

TEST(Segmentation, PointsAreTheBeamsEndsInTheSensorFrame) {
  const SegmentedScan segmented(scanOfRanges({2, 2}), pairsOnly());
  const auto runs = segmented.runs();
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_NEAR(runs[0].back().x, 2 * std::cos(kDegree), 1e-12);
  EXPECT_NEAR(runs[0].back().y, 2 * std::sin(kDegree), 1e-12);
}

std::vector<PointRange> pieces(const std::vector<TPoint2D>& points, const SegmentationOptions& options) {
  std::vector<PointRange> result;
  splitAtCorners(test::range(points), options, result);
  return result;
}

TEST(SplitAtCorners, ACornerBelongsToBothPieces) {
  std::vector<TPoint2D> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(0.1 * i, 0);
  for (int i = 0; i <= 20; ++i) points.emplace_back(1, 0.1 * i);
  const auto found = pieces(points, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].size(), 11u);
  EXPECT_EQ(found[1].size(), 21u);
  EXPECT_EQ(&found[0].back(), &found[1].front());
}

TEST(SplitAtCorners, AStraightNoisyWallStaysWhole) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(pieces(test::pointsOnLine(3, 0.7, -4, 4, 200, 0.012, random), {}).size(), 1u);
}

TEST(SplitAtCorners, AClosedSquareGivesItsFourSides) {
  std::vector<TPoint2D> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(0.1 * i, 0);
  for (int i = 0; i < 20; ++i) points.emplace_back(2, 0.1 * i);
  for (int i = 0; i < 20; ++i) points.emplace_back(2 - 0.1 * i, 2);
  for (int i = 0; i <= 20; ++i) points.emplace_back(0, 2 - 0.1 * i);
  EXPECT_EQ(pieces(points, {}).size(), 4u);
}

TEST(SplitAtCorners, EveryPieceIsWithinTheDistanceOfItsChord) {
  RandomStream random(2, 0, 0);
  const SegmentationOptions options;
  size_t all = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<TPoint2D> points;
    for (int k = 0; k < 60; ++k) points.emplace_back(0.05 * k, 0.3 * random.gaussian() * (k % 10 == 0));
    for (const PointRange& piece : pieces(points, options)) {
      EXPECT_GE(piece.size(), static_cast<size_t>(options.minPoints));
      const LineSegment chord = makeSegment(piece.front(), piece.back());
      for (const TPoint2D& p : piece)
        EXPECT_LE(std::abs(signedDistance(p, chord.rho, chord.theta)), options.splitDistance + 1e-9);
      ++all;
    }
  }
  EXPECT_GT(all, 400u);
}

TEST(SplitAtCorners, PointsAllInOnePlaceAreOnePiece) {
  EXPECT_EQ(pieces(std::vector<TPoint2D>(10, TPoint2D(1, 2)), {}).size(), 1u);
}

TEST(SegmentationOptions, RangesAreChecked) {
  for (const char* line : {"min_points = 1", "gap_absolute = -1", "split_distance = 0", "min_length = -2"}) {
    SegmentationOptions options;
    const mrpt::config::CConfigFileMemory file(std::string("[segmentation]\n") + line + "\n");
    EXPECT_THROW(options.loadFromConfigFile(file, "segmentation"), InputError) << line;
  }
}

}  // namespace
}  // namespace hybrid_slam
