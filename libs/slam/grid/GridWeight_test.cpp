#include "slam/grid/GridWeight.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include "base/Degree.h"
#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using Method = GridWeightOptions::Method;

constexpr double kWidth = 8, kHeight = 6;  // of a room with its middle at the origin, m

/// Distance to the room's walls from a point inside.
double castRay(double x, double y, double heading) {
  const double dx = std::cos(heading), dy = std::sin(heading);
  const double toX = dx == 0 ? 1e9 : ((dx > 0 ? 0.5 : -0.5) * kWidth - x) / dx;
  const double toY = dy == 0 ? 1e9 : ((dy > 0 ? 0.5 : -0.5) * kHeight - y) / dy;
  return std::min(toX, toY);
}

/// A scan of 181 beams over 180 deg with 1 cm of noise.
CObservation2DRangeScan mrptScanAt(const TPose2D& robot, RandomStream& random) {
  CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(M_PI);
  scan.maxRange = 80;
  scan.sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 0, 0);
  scan.resizeScan(181);
  const TPose2D laser = robot + TPose2D(0.2, 0, 0);
  for (size_t i = 0; i < 181; ++i) {
    const double heading = laser.phi + (static_cast<double>(i) - 90) * kDegree;
    scan.setScanRange(i, static_cast<float>(castRay(laser.x, laser.y, heading) + 0.01 * random.gaussian()));
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

OccupancyGrid roomGrid() {
  RandomStream random(1, 0, 0);
  OccupancyGrid grid(0.05);
  for (int i = 0; i < 40; ++i) {
    const TPose2D robot(4 * random.uniform() - 2, 3 * random.uniform() - 1.5, 2 * M_PI * random.uniform());
    grid.insert(ScanBeams(toLaserScan(mrptScanAt(robot, random), 20)), robot, GridOptions());
  }
  return grid;
}

struct NamedMethod {
  Method method;
  std::string name;
};

class GridWeightMethods : public testing::TestWithParam<NamedMethod> {
 protected:
  double weight(const CObservation2DRangeScan& observation, const TPose2D& robot) const {
    const LaserScan scan = toLaserScan(observation, 20);
    return GridWeight(options(), 0.05).logWeight(ScanBeams(scan), {scan}, robot, grid());
  }
  static const OccupancyGrid& grid() {
    static const OccupancyGrid room = roomGrid();
    return room;
  }
  GridWeightOptions options() const {
    GridWeightOptions o;
    o.method = GetParam().method;
    return o;
  }
};

TEST_P(GridWeightMethods, PrefersTheTruePose) {
  RandomStream random(2, 0, 0);
  for (const TPose2D& truth : {TPose2D(0, 0, 0), TPose2D(1, -0.7, 2), TPose2D(-1.5, 0.4, -1)}) {
    const CObservation2DRangeScan scan = mrptScanAt(truth, random);
    const double right = weight(scan, truth);
    EXPECT_TRUE(std::isfinite(right));
    EXPECT_LE(right, 0);
    for (const TPose2D& off : {TPose2D(0.3, 0, 0), TPose2D(-0.3, 0, 0), TPose2D(0, 0.3, 0),
                               TPose2D(0, -0.3, 0), TPose2D(0, 0, 8 * kDegree), TPose2D(0, 0, -8 * kDegree)})
      EXPECT_GT(right, weight(scan, truth + off) + 1e-4) << off.asString();
  }
}

TEST_P(GridWeightMethods, AnEmptyScanIsNeutral) {
  RandomStream random(3, 0, 0);
  CObservation2DRangeScan scan = mrptScanAt({0, 0, 0}, random);
  for (size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRangeValidity(i, false);
  EXPECT_EQ(weight(scan, {0, 0, 0}), 0);
}

TEST_P(GridWeightMethods, InvalidReadingsAreIgnored) {
  RandomStream random(4, 0, 0);
  const CObservation2DRangeScan whole = mrptScanAt({0.5, 0.5, 1}, random);
  CObservation2DRangeScan marked = whole, unmarked = whole;
  for (size_t i = 5; i < 181; i += 10) marked.setScanRangeValidity(i, false);
  const float bad[] = {
      81.83f, 25, 0, -1, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
  for (size_t i = 5; i < 181; i += 10) unmarked.setScanRange(i, bad[i % 6]);
  EXPECT_EQ(weight(unmarked, {0.5, 0.5, 1}), weight(marked, {0.5, 0.5, 1}));
}

/// The same scan from a sensor that is upside down or slightly tilted: it looks the same from above.
TEST_P(GridWeightMethods, TheMountingDoesNotMatter) {
  RandomStream random(5, 0, 0);
  const TPose2D robot(0.5, 0.5, 1);
  const CObservation2DRangeScan upright = mrptScanAt(robot, random);
  CObservation2DRangeScan turned = upright, tilted = upright;
  turned.sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 0, M_PI);
  turned.rightToLeft = false;
  tilted.sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 2 * kDegree, 0);
  EXPECT_NEAR(weight(turned, robot), weight(upright, robot), 1e-6);
  EXPECT_NEAR(weight(tilted, robot), weight(upright, robot), 1e-6);
}

TEST_P(GridWeightMethods, AScanOffTheMapIsFinite) {
  RandomStream random(6, 0, 0);
  const CObservation2DRangeScan scan = mrptScanAt({0, 0, 0}, random);
  EXPECT_TRUE(std::isfinite(weight(scan, {1000, 1000, 0})));
  EXPECT_LE(weight(scan, {1000, 1000, 0}), 0);
}

/// MRPT's consensus uses all beams of the scan, also those that were not selected, and checks no bounds.
TEST_P(GridWeightMethods, ASelectionWithoutTheLongestBeam) {
  RandomStream random(7, 0, 0);
  const TPose2D robot(0.5, 0.5, 1);
  const CObservation2DRangeScan scan = mrptScanAt(robot, random);
  LaserScan all = toLaserScan(scan, 80);
  for (const size_t i : {20u, 90u, 160u}) all.beams[i].range = 60;
  LaserScan selected = all;
  for (Beam& beam : selected.beams) beam.valid = beam.range < 3;
  const double value = GridWeight(options(), 0.05).logWeight(ScanBeams(selected), {all}, robot, grid());
  EXPECT_TRUE(std::isfinite(value));
}

INSTANTIATE_TEST_SUITE_P(All, GridWeightMethods,
                         testing::Values(NamedMethod{Method::penetration, "penetration"},
                                         NamedMethod{Method::likelihoodField, "likelihood_field"},
                                         NamedMethod{Method::rayTracing, "ray_tracing"},
                                         NamedMethod{Method::consensus, "consensus"}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace hybrid_slam
