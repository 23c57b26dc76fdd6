#include "slam/grid/CorrelativeSearch.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "base/Degree.h"
#include "testing/TestRoomGrid.h"

namespace hybrid_slam {
namespace {

using namespace test;
using mrpt::math::TPose2D;

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

/// The overlap of a scan of at most 120 beams `shift` cells beside a pose, by its definition.
long overlap(const ScanBeams& scan, const OccupancyGrid& grid, const TPose2D& pose, const CellIndex& shift) {
  const GridPose frame(pose, scan, grid.resolution());
  long sum = 0;
  for (const ScanBeams::Ray& ray : scan.rays) {
    const double range = ray.range / grid.resolution();
    const int x = shift.x + static_cast<int>(std::floor(frame.origin(ray).x + range * frame.dirX(ray)));
    const int y = shift.y + static_cast<int>(std::floor(frame.origin(ray).y + range * frame.dirY(ray)));
    double highest = 0;
    for (const int dx : {-1, 0, 1})
      for (const int dy : {-1, 0, 1}) highest = std::max(highest, 2 * grid.occupancy({x + dx, y + dy}) - 1);
    sum += std::lround(255 * highest);
  }
  return sum;
}

TEST(CorrelativeSearch, TheBestHasTheLargestOverlapOfTheLattice) {
  const OccupancyGrid grid = test::gridOf(kRoom);
  const double step = 2 * grid.resolution();
  RandomStream random(5, 0, 0);
  for (const double distance : {0.1, 0.5, 0.8, 1.7}) {  // rows of 3, 11, 17 and 35 poses
    ScanBeams scan = test::beamsAt(kRoom, {0.4, 0.3, 0.2}, random);
    ASSERT_GE(scan.rays.size(), 120u);
    scan.rays.resize(120);
    const TPose2D centre(0.9 * random.uniform(), 0.5 * random.uniform(), random.uniform());
    const SearchWindow window{distance, 3 * kDegree};
    const auto best = correlativeSearch(scan, centre, grid, window, 1);
    ASSERT_EQ(best.size(), 1u);
    const int n = static_cast<int>(std::lround(distance / step));
    long most = 0, ofBest = 0;
    for (int k = -3; k <= 3; ++k)
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i) {
          const TPose2D turned(centre.x, centre.y, centre.phi + k * kDegree);
          const long own = overlap(scan, grid, turned, {2 * i, 2 * j});
          most = std::max(most, own);
          if (away(best[0], {centre.x + i * step, centre.y + j * step, 0}) < 1e-6 &&
              std::abs(best[0].phi - turned.phi) < 1e-6)
            ofBest = own;
        }
    EXPECT_GT(most, 0);
    EXPECT_EQ(ofBest, most) << distance;
  }
}

TEST(CorrelativeSearch, AnEmptyScanOrMapGivesNoPose) {
  RandomStream random(4, 0, 0);
  EXPECT_TRUE(
      correlativeSearch(test::beamsAt(kRoom, {}, random), {}, OccupancyGrid(0.05), kWindow, 8).empty());
  EXPECT_TRUE(correlativeSearch(ScanBeams(LaserScan()), {}, test::gridOf(kRoom), kWindow, 8).empty());
}

}  // namespace
}  // namespace hybrid_slam
