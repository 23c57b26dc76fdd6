#include "slam/lines/LineAssociation.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include "base/Errors.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// The segment of x cos(theta) + y sin(theta) = rho from `from` to `to` m from the foot of the perpendicular.
LineSegment piece(double rho, double theta, double from = -3, double to = 3) {
  const double c = std::cos(theta), s = std::sin(theta);
  return makeSegment(rho, theta, TPoint2D(rho * c - from * s, rho * s + from * c),
                     TPoint2D(rho * c - to * s, rho * s + to * c));
}

/// If the midpoint is the foot of the perpendicular, the differences are those of the parameters.
TEST(LineDifference, PlainDifferenceOfTheParameters) {
  const LineDifference d = difference(piece(4.1, 0.52), piece(4, 0.5));
  EXPECT_NEAR(d.theta, 0.02, 1e-12);
  EXPECT_NEAR(d.rho, 4.1 * std::cos(0.02) - 4, 1e-12);
  EXPECT_NEAR(difference(piece(4.1, 0.5), piece(4, 0.5)).rho, 0.1, 1e-12);
}

TEST(LineDifference, NeighboursAcrossTheWrapOfTheAngle) {
  const LineDifference d = difference(piece(4, -M_PI + 0.01), piece(4, M_PI - 0.01));
  EXPECT_NEAR(d.theta, 0.02, 1e-12);
  EXPECT_NEAR(d.rho, 0, 1e-3);
  EXPECT_TRUE(matchDistance(piece(4, -M_PI + 0.01), piece(4, M_PI - 0.01), {}));
}

TEST(LineDifference, NeighboursWhereRhoPassesThroughZero) {
  const LineSegment a = piece(0.02, 0.3), b = piece(-0.03, 0.31);
  EXPECT_GT(std::abs(a.theta - b.theta), 3);  // the normals point to opposite sides
  const LineDifference d = difference(b, a);
  EXPECT_NEAR(d.theta, 0.01, 1e-12);
  EXPECT_NEAR(d.rho, -0.05, 1e-5);
  EXPECT_TRUE(matchDistance(b, a, {}));
}

/// Two walls of a corridor have opposite normals and equal rho: they are not one line.
TEST(LineDifference, OppositeWallsAreFarApart) {
  EXPECT_NEAR(difference(piece(1, M_PI), piece(1, 0)).rho, -2, 1e-12);
  EXPECT_FALSE(matchDistance(piece(1, M_PI), piece(1, 0), {}));
}

TEST(LineDifference, DoesNotDependOnTheFrame) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const LineSegment a = test::randomSegment(random, 10), b = test::randomSegment(random, 10);
    const TPose2D frame = test::randomPose(random, 100);
    const LineDifference here = difference(a, b),
                         there = difference(transformed(a, frame), transformed(b, frame));
    // The reference's normal may point to the other side there; only rho's sign tells.
    EXPECT_NEAR(std::abs(there.rho), std::abs(here.rho), 1e-9);
    EXPECT_NEAR(std::abs(std::remainder(there.theta - here.theta, M_PI)), 0, 1e-9);
    EXPECT_NEAR(there.overlap, here.overlap, 1e-9);
  }
}

TEST(LineDifference, OverlapByHand) {
  const LineSegment reference = makeSegment(TPoint2D(0, 2), TPoint2D(5, 2));
  struct Case {
    double from, to, overlap;
  };
  for (const Case& c :
       {Case{1, 3, 2}, Case{-2, 1, 1}, Case{4, 9, 1}, Case{-1, 7, 5}, Case{6, 9, -1}, Case{-4, -2, -2}})
    for (const bool swapped : {false, true}) {
      const TPoint2D a(c.from, 2.1), b(c.to, 2.1);
      EXPECT_NEAR(difference(swapped ? makeSegment(b, a) : makeSegment(a, b), reference).overlap, c.overlap,
                  1e-12);
    }
}

TEST(LineAssociation, DistanceAndThresholds) {
  AssociationOptions options;
  options.maxRho = 0.2;
  options.maxTheta = 0.1;
  options.thetaWeight = 2;
  const LineSegment reference = piece(4, 0);
  const auto distance = matchDistance(piece(4.1, 0.05), reference, options);
  ASSERT_TRUE(distance);
  EXPECT_NEAR(*distance, std::hypot(4.1 * std::cos(0.05) - 4, 2 * 0.05), 1e-12);
  EXPECT_TRUE(matchDistance(piece(4.19, 0), reference, options));
  EXPECT_FALSE(matchDistance(piece(4.21, 0), reference, options));
  EXPECT_FALSE(matchDistance(piece(3.79, 0), reference, options));
  EXPECT_TRUE(matchDistance(piece(4, -0.09), reference, options));
  EXPECT_FALSE(matchDistance(piece(4, 0.11), reference, options));
  EXPECT_FALSE(matchDistance(piece(4, -0.11), reference, options));
}

TEST(LineAssociation, SegmentsOfOneLineMustOverlap) {
  AssociationOptions options;
  const LineSegment reference = piece(4, 0, 0, 5);
  EXPECT_FALSE(matchDistance(piece(4, 0, 5.5, 8), reference, options));
  options.minOverlap = -1;
  EXPECT_TRUE(matchDistance(piece(4, 0, 5.5, 8), reference, options));
  options.minOverlap = 1;
  EXPECT_FALSE(matchDistance(piece(4, 0, 4.5, 8), reference, options));
}

/// 60 m from the map's origin an angle error of 1 deg moves rho by a metre: still the same wall.
TEST(LineAssociation, FarFromTheOrigin) {
  const LineSegment wall = makeSegment(TPoint2D(60, 3), TPoint2D(66, 3));
  const LineSegment seen = makeSegment(TPoint2D(60, 3.05), TPoint2D(66, 2.95));
  EXPECT_GT(std::abs(seen.rho - wall.rho), 1);
  EXPECT_TRUE(matchDistance(seen, wall, {}));
}

TEST(AssociationOptions, RangesAreChecked) {
  for (const char* line : {"max_rho = -1", "max_theta_deg = 46", "theta_weight = -1", "max_teta_deg = 3"}) {
    AssociationOptions options;
    const mrpt::config::CConfigFileMemory file(std::string("[line_association]\n") + line + "\n");
    EXPECT_THROW(options.loadFromConfigFile(file, "line_association"), InputError) << line;
  }
}

}  // namespace
}  // namespace hybrid_slam
