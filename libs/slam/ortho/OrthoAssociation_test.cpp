#include "slam/ortho/OrthoAssociation.h"

#include <gtest/gtest.h>

#include "testing/TestScans.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// A wall 3 m ahead of a robot, turned by `angle`.
LineSegment ahead(double angle) { return makeSegment(3, angle, {3, -1}, {3, 1}); }

TEST(OrthoAssociation, OnlyLinesAlongAnAxisAreKept) {
  const std::vector<LineSegment> seen{ahead(0), ahead(4 * kDegree), ahead(6 * kDegree), ahead(45 * kDegree)};
  const auto kept = orthogonalLines(seen, 0, 5 * kDegree);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_NEAR(kept[1].deviation, 4 * kDegree, 1e-9);
  EXPECT_EQ(orthogonalLines(seen, -45 * kDegree, 5 * kDegree).size(), 1u);
  EXPECT_TRUE(orthogonalLines({}, 1, 5 * kDegree).empty());
}

TEST(OrthoAssociation, SidesAreQuarterTurns) {
  const double headings[] = {0, 90, 180, -90, 270, 360, -360};
  const int sides[] = {0, 1, 2, 3, 3, 0, 0};
  for (int i = 0; i < 7; ++i)
    EXPECT_EQ(orthogonalLines({ahead(0)}, headings[i] * kDegree, 0.1).at(0).side, sides[i]) << headings[i];
}

TEST(OrthoAssociation, PlacedByThePose) {
  const TPose2D pose(5, 2, 90 * kDegree);
  const SeenOrthoLine seen = orthogonalLines({ahead(0)}, pose.phi, 0.1).at(0);
  const PlacedLine placed(seen, pose);
  EXPECT_NEAR(placed.offset, 5, 1e-9);  // y = 2 + 3
  EXPECT_NEAR(placed.low, 4, 1e-9);
  EXPECT_NEAR(placed.high, 6, 1e-9);
  for (int i = 0; i < 3; ++i) {
    const double step = 1e-6;
    TPose2D other = pose;
    other[static_cast<size_t>(i)] += step;
    EXPECT_NEAR(placed.byPose[i], (PlacedLine(seen, other).offset - placed.offset) / step, 1e-5) << i;
  }
}

class Association : public testing::Test {
 protected:
  /// The walls y = 5 and y = 5.4 from x = 0 to 4, seen from below.
  Association() {
    state.add(5, {0, 0, 0}, 1e-6);
    state.add(5.4, {0, 0, 0}, 1e-6);
    lines = {{1, 0, 4, 1, 0}, {1, 0, 4, 1, 0}};
    options.sigmaOffset = 0.1;
  }
  /// The match of a line of 1 m seen from below, its middle at (x, y).
  std::optional<size_t> matchOf(double x, double y, int side = 1) const {
    const SeenOrthoLine seen{{x, y}, 0, 1, side};
    return associate(seen, PlacedLine(seen, {}), lines, state, options);
  }
  OrthoState state;
  std::vector<OrthoLine> lines;
  OrthoOptions options;
};

TEST_F(Association, NearestWithinTheGate) {
  EXPECT_EQ(matchOf(2, 5.1), 0u);
  EXPECT_EQ(matchOf(2, 5.25), 1u);
  EXPECT_EQ(matchOf(2, 4.71), 0u);
  EXPECT_FALSE(matchOf(2, 4.69));
}

TEST_F(Association, GapAndSide) {
  EXPECT_EQ(matchOf(5.4, 5), 0u);  // 0.9 m away
  EXPECT_FALSE(matchOf(5.6, 5));   // 1.1 m
  EXPECT_FALSE(matchOf(2, 5, 3));  // the other face of the wall
  EXPECT_FALSE(matchOf(5, 2, 0));  // across
}

}  // namespace
}  // namespace hybrid_slam
