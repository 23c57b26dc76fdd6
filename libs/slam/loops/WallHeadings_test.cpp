#include "slam/loops/WallHeadings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/Degree.h"
#include "base/RandomStream.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// A straight path of 400 m with a keyframe each metre. The walls along it are parallel to the x axis of the
/// map, but for errors.
struct Drive {
  std::vector<TPose2D> poses;
  std::vector<double> distances;
  std::vector<std::optional<double>> walls;

  /// @param wallAngle, headingError  rad, at a distance (m)
  template <class WallAngle, class HeadingError>
  Drive(const WallAngle& wallAngle, const HeadingError& headingError, double noise) {
    RandomStream random(1, 0, 0);
    for (int x = 0; x <= 400; ++x) {
      distances.push_back(x);
      poses.emplace_back(x, 0, headingError(x));
      walls.emplace_back(wallAngle(x) + noise * random.gaussian());
    }
  }
  std::vector<PoseEdge> edges(double direction = 0) const {
    return wallHeadings(poses, distances, walls, direction);
  }
};

double none(double) { return 0; }
/// A building at an angle to the others.
double turnedBuilding(double x) { return x > 200 && x < 270 ? 2 * kDegree : 0; }
double wrongTurn(double x) { return x > 170 ? 2 * kDegree : 0; }
double drift(double x) { return x / 400 * 2 * kDegree; }

TEST(WallHeadings, AreTheHeadingsOfTheTruth) {
  for (const auto error : {none, wrongTurn, drift}) {
    const Drive drive(none, error, 0.3 * kDegree);
    const auto edges = drive.edges();
    ASSERT_EQ(edges.size(), 400u);
    double sum = 0;
    for (const PoseEdge& edge : edges) {
      EXPECT_EQ(edge.from, 0u);
      EXPECT_NEAR(edge.relative.phi, 0, 4 * 0.3 * kDegree);
      EXPECT_DOUBLE_EQ(edge.information(0, 0), 0);
      sum += edge.relative.phi;
    }
    EXPECT_NEAR(sum / 400, 0, 4 * 0.3 * kDegree / std::sqrt(400));
  }
}

TEST(WallHeadings, HaveTwiceTheNoiseOfTheTurns) {
  for (const double noise : {0.3, 1.0}) {
    const auto edges = Drive(none, none, noise * kDegree).edges();
    ASSERT_FALSE(edges.empty());
    const double sigma = 1 / std::sqrt(edges[0].information(2, 2)) / kDegree;
    EXPECT_NEAR(sigma, 2 * std::sqrt(2) * noise, 0.1 * sigma) << "a difference has the noise of two headings";
  }
  const auto exact = Drive(none, none, 0).edges();
  ASSERT_FALSE(exact.empty());
  EXPECT_NEAR(1 / std::sqrt(exact[0].information(2, 2)), 0.2 * kDegree, 1e-9);
}

// On campuses, a closure turned the path along a building to the direction of the others: 0.4 to 0.7 m.
TEST(WallHeadings, ThereAreNoneIfABuildingIsAtAnAngleToTheOthers) {
  for (const double noise : {0.0, 0.1, 0.3})
    EXPECT_TRUE(Drive(turnedBuilding, none, noise * kDegree).edges().empty()) << noise;
}

TEST(WallHeadings, OtherWallsAreLeftOut) {
  Drive drive([](double x) { return x < 100 ? 10 * kDegree : 0; }, none, 0.1 * kDegree);
  for (size_t i = 300; i <= 400; ++i) drive.walls[i] = std::nullopt;
  const auto edges = drive.edges();
  ASSERT_EQ(edges.size(), 200u);
  EXPECT_EQ(edges.front().to, 100u);
  EXPECT_EQ(edges.back().to, 299u);
  EXPECT_TRUE(Drive(none, none, 0).edges(20 * kDegree).empty());
}

TEST(WallHeadings, AScanNeedsThreeMetresOfWalls) {
  const LineSegment two = makeSegment({0, 1}, {2, 1});
  EXPECT_FALSE(wallDirection({two}));
  const auto direction = wallDirection({two, makeSegment({2, 1}, {2, 3})});
  ASSERT_TRUE(direction);
  EXPECT_NEAR(std::remainder(*direction, M_PI / 2), 0, 1e-12);
}

}  // namespace
}  // namespace hybrid_slam
