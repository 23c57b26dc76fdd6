#include "readings/FrozenLasers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/Degree.h"
#include "base/LaserScan.h"
#include "base/Segments.h"
#include "readings/Timestamps.h"

namespace hybrid_slam::readings {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;

namespace {

constexpr size_t kFewestReturns = 10;  // in the open, a laser often sees nothing
constexpr double kMovedOn = 0.05,
                 kTurnedOn = 0.02;  // m, rad: scans must differ, and odometry is interpolated
constexpr double kDrift = 0.01, kTurnDrift = 0.5 * kDegree;  // m/s, rad/s, of a robot that stands
constexpr double kOnWall = 0.002;  // m; few points of a moved scan with noise are closer
constexpr double kMostOnWall = 0.8;
constexpr size_t kPoints = 90;  // compared with the walls

bool hasSameReturns(const CObservation2DRangeScan& a, const CObservation2DRangeScan& b) {
  if (a.getScanSize() != b.getScanSize()) return false;
  size_t returns = 0;
  for (size_t i = 0; i < a.getScanSize(); ++i) {
    if (a.getScanRangeValidity(i) != b.getScanRangeValidity(i)) return false;
    if (!a.getScanRangeValidity(i)) continue;
    if (a.getScanRange(i) != b.getScanRange(i)) return false;
    ++returns;
  }
  return returns >= kFewestReturns;
}

/// Returns whether the odometry moves so slowly between two scans that the robot may stand.
bool isDrift(const TPose2D& moved, const CObservation2DRangeScan& before,
             const CObservation2DRangeScan& later) {
  if (!isStamped(before) || !isStamped(later)) return false;
  const double time = seconds(later.timestamp) - seconds(before.timestamp);
  return moved.norm() <= kDrift * time && std::abs(moved.phi) <= kTurnDrift * time;
}

/// Returns whether a moved laser may see the same: its points lie on the walls that it saw before. It has not
/// turned then, and a small turn is an error of the odometry.
/// @param moved  of the robot
bool isAlongWalls(const CObservation2DRangeScan& observation, const TPose2D& moved) {
  if (std::abs(moved.phi) > kTurnedOn) return false;
  const LaserScan scan = toLaserScan(observation, std::numeric_limits<double>::infinity());
  std::vector<TPoint2D> points;  // frame of the laser
  for (const Beam& beam : scan.beams)
    if (beam.valid) points.emplace_back(beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle));
  const TPoint2D shift = TPose2D(0, 0, -scan.sensorPose.phi).composePoint(TPoint2D(moved.x, moved.y));
  const size_t stride = (points.size() + kPoints - 1) / kPoints;
  size_t all = 0, onWall = 0;
  for (size_t i = 0; i < points.size(); i += stride, ++all) {
    const TPoint2D point = points[i] + shift;
    for (size_t j = 1; j < points.size(); ++j)
      if ((point - nearestOnSegment(point, points[j - 1], points[j])).norm() < kOnWall) {
        ++onWall;
        break;
      }
  }
  return static_cast<double>(onWall) >= kMostOnWall * static_cast<double>(all);
}

}  // namespace

bool FrozenLasers::isFrozen(const CObservation2DRangeScan::Ptr& scan, const TPose2D& odometry) {
  const auto [newest, isFirst] = newest_.try_emplace(scan->sensorLabel, Seen{scan, odometry});
  if (isFirst) return false;
  Seen& before = newest->second;
  if (hasSameReturns(*before.scan, *scan)) {
    const TPose2D moved = odometry - before.odometry;
    if (moved.norm() <= kMovedOn && std::abs(moved.phi) <= kTurnedOn) return false;
    if (!isDrift(moved, *before.scan, *scan) && !isAlongWalls(*scan, moved)) return true;
  }
  before = {scan, odometry};
  return false;
}

}  // namespace hybrid_slam::readings
