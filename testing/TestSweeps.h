/// @file TestSweeps.h
/// @brief For the tests: scans whose beams are measured one after another while the robot moves in the room
/// of TestLogs.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/BeamFan.h"
#include "base/LaserScan.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

/// Pose of the robot in the room (m, rad) after a time (s).
using Motion = std::function<TPose2D(double)>;

struct SweptLaser {
  mrpt::poses::CPose3D sensorPose = mrpt::poses::CPose3D(0.3, -0.1, 0.2, 0.4, 0, 0);
  bool rightToLeft = true;
  double aperture = M_PI;
  double sweep = 0.1;  ///< s, from the first beam to the last
  size_t beams = 181;
  std::string label = "LASER";
};

/// The scan whose first beam is measured at `time`.
inline CObservation2DRangeScan::Ptr sweptScan(const SweptLaser& laser, double time, const Motion& motion) {
  auto out = CObservation2DRangeScan::Create();
  out->timestamp = stamp(time);
  out->sensorLabel = laser.label;
  out->aperture = static_cast<float>(laser.aperture);
  out->rightToLeft = laser.rightToLeft;
  out->maxRange = 20;
  out->sensorPose = laser.sensorPose;
  out->resizeScan(laser.beams);
  const BeamFan fan(*out);
  for (size_t i = 0; i < laser.beams; ++i) {
    const double after = laser.sweep * static_cast<double>(i) / static_cast<double>(laser.beams - 1);
    const TPose2D sensor = motion(time + after) + fan.sensorPose();
    out->setScanRange(i, static_cast<float>(rangeInRoom(sensor.x, sensor.y, sensor.phi + fan.angle(i))));
    out->setScanRangeValidity(i, true);
  }
  return out;
}

/// The largest distance (m) of a beam's end from the walls, for a scan taken at this pose.
inline double farthestFromWalls(const CObservation2DRangeScan& observation, const TPose2D& robot) {
  const LaserScan scan = toLaserScan(observation, 20);
  double farthest = 0;
  for (const Beam& beam : scan.beams) {
    if (!beam.valid) continue;
    const auto end =
        (robot + scan.sensorPose)
            .composePoint({beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle)});
    farthest = std::max(
        farthest, std::min(std::abs(kHalfLength - std::abs(end.x)), std::abs(kHalfWidth - std::abs(end.y))));
  }
  return farthest;
}

}  // namespace hybrid_slam::test
