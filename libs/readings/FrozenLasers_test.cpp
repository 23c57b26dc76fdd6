#include "readings/FrozenLasers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/Degree.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;

constexpr double kMaxRange = 8;

/// A scan of 181 beams between two walls 2 m apart. @param end  m, where the corridor ends ahead
CObservation2DRangeScan::Ptr corridor(double time, double end, double noise = 0) {
  std::mt19937 random(1);
  std::normal_distribution<> error(0, 1);
  const auto scan = test::scan(time);
  const size_t beams = scan->getScanSize();
  scan->maxRange = kMaxRange;
  for (size_t i = 0; i < beams; ++i) {
    const double angle = scan->aperture * (static_cast<double>(i) / static_cast<double>(beams - 1) - 0.5);
    const double range = std::min(1 / std::abs(std::sin(angle)), end / std::cos(angle));
    scan->setScanRange(i, static_cast<float>(range + noise * error(random)));
    scan->setScanRangeValidity(i, range < kMaxRange);
  }
  return scan;
}

/// Whether a scan, taken again at another place, counts as an old one.
bool isFrozen(CObservation2DRangeScan::Ptr (*at)(double), const TPose2D& moved, double seconds = 0.2) {
  FrozenLasers lasers;
  EXPECT_FALSE(lasers.isFrozen(at(1), {}));
  return lasers.isFrozen(at(1 + seconds), moved);
}

CObservation2DRangeScan::Ptr room(double time) { return corridor(time, 3); }
CObservation2DRangeScan::Ptr endless(double time) { return corridor(time, 100); }
CObservation2DRangeScan::Ptr measured(double time) { return corridor(time, 100, 0.003); }

TEST(FrozenLasers, ARobotThatMovesInARoomSeesSomethingElse) {
  EXPECT_TRUE(isFrozen(room, {0.1, 0, 0}));
  EXPECT_TRUE(isFrozen(room, {0, 0, 2 * kDegree}));
  EXPECT_FALSE(isFrozen(room, {0.04, 0, 0})) << "odometry may have errors";
}

TEST(FrozenLasers, AlongACorridorASimulationWithoutNoiseSeesTheSame) {
  for (const double way : {0.1, 0.5, 1.}) EXPECT_FALSE(isFrozen(endless, {way, 0, 0})) << way;
  EXPECT_TRUE(isFrozen(endless, {0.1, 0.05, 0})) << "across it";
  EXPECT_TRUE(isFrozen(endless, {0.1, 0, 2 * kDegree}));
  EXPECT_TRUE(isFrozen(measured, {0.1, 0, 0})) << "a scan has noise";
}

TEST(FrozenLasers, AlongACorridorEachScanIsComparedWithTheLastOne) {
  FrozenLasers lasers;
  TPose2D odometry;
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(lasers.isFrozen(endless(1 + 0.2 * i), odometry)) << i;
    odometry = odometry + TPose2D(0.1, 0, 0.5 * kDegree * std::sin(i));
  }
}

TEST(FrozenLasers, ARobotWhoseOdometryDriftsMayStand) {
  FrozenLasers lasers;
  for (int i = 0; i < 200; ++i)
    EXPECT_FALSE(lasers.isFrozen(room(1 + 0.2 * i), {0, 0, 0.05 * kDegree * i})) << i;
  EXPECT_TRUE(lasers.isFrozen(room(42), {0.1, 0, 10 * kDegree})) << "it drives on";
}

TEST(FrozenLasers, AFrozenLaserStaysFrozenUntilItSeesSomethingElse) {
  FrozenLasers lasers;
  EXPECT_FALSE(lasers.isFrozen(room(1), {}));
  for (int i = 1; i < 20; ++i) EXPECT_TRUE(lasers.isFrozen(room(1 + 0.2 * i), {0.1 * i, 0, 0})) << i;
  EXPECT_FALSE(lasers.isFrozen(corridor(5, 2), {1, 0, 0}));
}

}  // namespace
}  // namespace hybrid_slam::readings
