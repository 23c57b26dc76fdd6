#include "benchmarks/Counterparts.h"

#include <gtest/gtest.h>

#include "benchmarks/Sigma.h"
#include "testing/TestScans.h"

namespace hybrid_slam::bench {
namespace {

using test::uniform;

struct Noise {
  double angle = 0, distance = 0;  ///< sigma of a line, rad and m
};

/// A line along a wall of direction `theta` (of the normal), with errors of its direction and of its middle.
LineSegment observed(const TPoint2D& middle, double theta, const Noise& noise, RandomStream& random) {
  const double off = noise.distance * random.gaussian();
  const TPoint2D m(middle.x + off * std::cos(theta), middle.y + off * std::sin(theta));
  theta += noise.angle * random.gaussian();
  const double x = std::sin(theta), y = -std::cos(theta);
  return makeSegment({m.x - x, m.y - y}, {m.x + x, m.y + y});
}

/// Counterparts of `count` walls around the robot. The second scan shows other parts of them, and the
/// odometry has an error.
/// @param directions  number of directions that the walls have; 0: each its own
std::vector<Counterpart> madeUp(int count, int directions, const Noise& noise, RandomStream& random) {
  const TPose2D error(0.1 * random.gaussian(), 0.1 * random.gaussian(), 2 * kDegree * random.gaussian());
  std::vector<Counterpart> pairs;
  for (int i = 0; i < count; ++i) {
    const TPoint2D middle(uniform(random, -5, 5), uniform(random, -5, 5));
    const double theta = directions > 0 ? M_PI / directions * (i % directions) : uniform(random, 0, M_PI);
    const double shift = uniform(random, -0.3, 0.3);
    const TPoint2D other(middle.x - shift * std::sin(theta), middle.y + shift * std::cos(theta));
    pairs.push_back(
        {observed(middle, theta, noise, random), transformed(observed(other, theta, noise, random), error)});
  }
  return pairs;
}

/// Differences of 20,000 pairs of scans with 1 to 6 counterparts each.
Differences differences(int directions, const Noise& noise, RandomStream& random) {
  Differences result;
  for (int i = 0; i < 20000; ++i) result.add(madeUp(1 + i % 6, directions, noise, random));
  return result;
}

TEST(Counterparts, TheSigmasOfTheLinesAreFoundUnderErrorsOfTheOdometry) {
  const Noise noise{0.5 * kDegree, 0.012};
  for (const int directions : {0, 1, 2}) {
    RandomStream random(1, 0, 0);
    const Differences d = differences(directions, noise, random);
    for (const auto& [sigma, expected] :
         {std::pair{sigmaOf(d.angles), noise.angle}, {sigmaOf(d.distances), noise.distance}}) {
      EXPECT_NEAR(sigma.robust / std::sqrt(2), expected, 0.03 * expected) << directions;
      EXPECT_NEAR(sigma.rms / std::sqrt(2), expected, 0.03 * expected) << directions;
    }
  }
}

TEST(Counterparts, AFewWrongOnesChangeTheRootMeanSquareAlone) {
  const Noise noise{0.5 * kDegree, 0.012};
  RandomStream random(4, 0, 0);
  Differences d = differences(0, noise, random);
  for (int i = 0; i < 200; ++i) {
    auto pairs = madeUp(6, 0, noise, random);
    pairs[0].second = transformed(
        pairs[0].second, {0.2 * std::cos(pairs[0].first.theta), 0.2 * std::sin(pairs[0].first.theta), 0});
    d.add(pairs);
  }
  const Sigma sigma = sigmaOf(d.distances);
  EXPECT_NEAR(sigma.robust / std::sqrt(2), noise.distance, 0.06 * noise.distance);
  EXPECT_GT(sigma.rms / std::sqrt(2), 1.2 * noise.distance);
}

TEST(Counterparts, AnErrorOfTheOdometryLeavesNoTrace) {
  RandomStream random(2, 0, 0);
  const Differences d = differences(0, {}, random);
  EXPECT_NEAR(sigmaOf(d.angles).rms, 0, 1e-9);
  EXPECT_NEAR(sigmaOf(d.distances).rms, 0, 1e-9);
}

TEST(Counterparts, GiveAsManyDifferencesAsLeastSquaresLeaveDegreesOfFreedom) {
  RandomStream random(3, 0, 0);
  for (int count = 0; count < 8; ++count) {
    Differences general, parallel;
    general.add(madeUp(count, 0, {}, random));
    parallel.add(madeUp(count, 1, {}, random));
    EXPECT_EQ(general.angles.size(), static_cast<size_t>(std::max(0, count - 1)));
    EXPECT_EQ(general.distances.size(), static_cast<size_t>(std::max(0, count - 3)));
    EXPECT_EQ(parallel.angles.size(), static_cast<size_t>(std::max(0, count - 1)));
    EXPECT_EQ(parallel.distances.size(), static_cast<size_t>(std::max(0, count - 2))) << "x and phi alone";
  }
}

TEST(Counterparts, AreTheNearestLinesInTheFrameOfTheFirstScan) {
  const std::vector<LineSegment> first{makeSegment({4, -3}, {4, 3}), makeSegment({4.2, -3}, {4.2, 3}),
                                       makeSegment({-3, 5}, {3, 5})};
  const TPose2D motion(0.3, 0.1, 10 * kDegree);
  const TPose2D back = TPose2D() - motion;
  const auto pairs = counterparts(first,
                                  {transformed(makeSegment({4.15, -2}, {4.15, 3}), back),  // the second
                                   transformed(makeSegment({-3, 5.4}, {3, 5.4}), back)},   // none: 0.4 m off
                                  motion);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first.rho, first[1].rho);
  EXPECT_NEAR(pairs[0].second.rho, 4.15, 1e-9);
}

}  // namespace
}  // namespace hybrid_slam::bench
