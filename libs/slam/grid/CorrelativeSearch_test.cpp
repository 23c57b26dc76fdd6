#include "slam/grid/CorrelativeSearch.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include "testing/TestRoomGrid.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::math::TPose2D;

constexpr double kDegree = mrpt::DEG2RAD(1.0);
const SearchWindow kWindow{0.5, 30 * kDegree};

double away(const TPose2D& a, const TPose2D& b) { return std::hypot(a.x - b.x, a.y - b.y); }
double turned(const TPose2D& a, const TPose2D& b) { return std::abs(mrpt::math::wrapToPi(a.phi - b.phi)); }

TEST(CorrelativeSearch, OneOfItsMaximaIsInTheBasinOfTheTruth) {
  const OccupancyGrid grid = test::gridOf(kRoom);
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
    const TPose2D truth(within(1.5), within(0.8), within(M_PI));
    const TPose2D centre(truth.x + within(0.5), truth.y + within(0.5), truth.phi + within(30 * kDegree));
    const auto places = correlativeSearch(test::beamsAt(kRoom, truth, random), centre, grid, kWindow, 8);
    EXPECT_LE(places.size(), 8u);
    EXPECT_TRUE(std::any_of(places.begin(), places.end(),
                            [&](const TPose2D& place) {
                              return away(place, truth) < 0.15 && turned(place, truth) < 2 * kDegree;
                            }))
        << truth.asString() << " from " << centre.asString();
  }
}

TEST(CorrelativeSearch, StaysInItsWindow) {
  const OccupancyGrid grid = test::gridOf(kRoom);
  RandomStream random(2, 0, 0);
  const TPose2D centre(0.3, -0.2, 3.1);
  const auto places =
      correlativeSearch(test::beamsAt(kRoom, {}, random), centre, grid, {0.3, 10 * kDegree}, 1000);
  EXPECT_GT(places.size(), 1u);
  for (const TPose2D& place : places) {
    EXPECT_LE(std::abs(place.x - centre.x), 0.3 + 1e-9);
    EXPECT_LE(std::abs(place.y - centre.y), 0.3 + 1e-9);
    EXPECT_LE(turned(place, centre), 10 * kDegree + 1e-9);
  }
}

TEST(CorrelativeSearch, TheBestComesFirst) {
  const OccupancyGrid grid = test::gridOf(kRoom);
  RandomStream random(3, 0, 0);
  const ScanBeams scan = test::beamsAt(kRoom, {}, random);
  const auto all = correlativeSearch(scan, {}, grid, kWindow, 1000);
  const auto one = correlativeSearch(scan, {}, grid, kWindow, 1);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0], all.at(0));
  EXPECT_EQ(one[0], TPose2D());  // the true pose
}

TEST(CorrelativeSearch, AnEmptyScanOrMapGivesNoPose) {
  RandomStream random(4, 0, 0);
  EXPECT_TRUE(
      correlativeSearch(test::beamsAt(kRoom, {}, random), {}, OccupancyGrid(0.05), kWindow, 8).empty());
  EXPECT_TRUE(correlativeSearch(ScanBeams(LaserScan()), {}, test::gridOf(kRoom), kWindow, 8).empty());
}

}  // namespace
}  // namespace hybrid_slam
