/// @file RingDrive.h
/// @brief For the tests: a robot that drives through corridors, and a path whose heading drifts.
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>

#include <memory>
#include <vector>

#include "testing/TestScans.h"

namespace hybrid_slam::test {

struct DrivenPose {
  TPose2D truth;
  TPose2D motion;  ///< since the previous pose, as estimated
  LaserScans scans;
};

inline void append(Walls& walls, const Walls& more) { walls.insert(walls.end(), more.begin(), more.end()); }

inline Walls box(double minX, double minY, double maxX, double maxY) {
  return polygon({{minX, minY}, {maxX, minY}, {maxX, maxY}, {minX, maxY}});
}

/// A corridor 3 m wide around a block of 30 m x 18 m, with cupboards so that no two places look alike; the
/// robot starts in its middle at the origin.
inline Walls ring() {
  Walls walls = box(-3, -1.5, 33, 22.5);
  append(walls, box(0, 1.5, 30, 19.5));
  for (const double x : {2.0, 5.5, 7.2, 12.1, 18.3, 19.9, 26.4}) append(walls, box(x, -1.5, x + 0.8, -1.0));
  for (const double x : {1.1, 9.0, 10.7, 16.2, 23.8, 28.5}) append(walls, box(x, 22.0, x + 0.5, 22.5));
  for (const double y : {3.3, 6.1, 8.0, 14.2}) append(walls, box(32.4, y, 33, y + 0.7));
  for (const double y : {4.4, 5.6, 11.5, 15.3}) append(walls, box(-3, y, -2.5, y + 0.6));
  return walls;
}

/// Drives along the corners in steps of 0.25 m and 15 deg, 181 beams over 180 deg with 1 cm of noise. The
/// estimated motions are the true ones, each turned by `turnPerMetre` (rad) and stretched by `scale`.
inline std::vector<DrivenPose> driveAlong(const Walls& walls, const std::vector<TPoint2D>& corners,
                                          double turnPerMetre, double scale = 1) {
  RandomStream random(1, 0, 0);
  std::vector<DrivenPose> drive;
  const auto look = [&](const TPose2D& truth, const TPose2D& motion) {
    drive.push_back({truth, motion, {scanOf(walls, truth, {0.2, 0, 0}, 181, M_PI, 0.01, random)}});
  };
  const auto go = [&](const TPose2D& motion) {
    look(drive.back().truth + motion,
         {scale * motion.x, scale * motion.y, motion.phi + turnPerMetre * motion.x});
  };
  look({corners[0].x, corners[0].y, 0}, {});
  for (size_t i = 1; i < corners.size(); ++i) {
    const TPose2D from = drive.back().truth;
    const double dx = corners[i].x - from.x, dy = corners[i].y - from.y;
    const double turn = std::remainder(std::atan2(dy, dx) - from.phi, 2 * M_PI);
    const int turns = static_cast<int>(std::ceil(std::abs(turn) / (15 * kDegree)));
    for (int k = 0; k < turns; ++k) go({0, 0, turn / turns});
    const double distance = std::hypot(dx, dy);
    const int steps = static_cast<int>(std::ceil(distance / 0.25));
    for (int k = 0; k < steps; ++k) go({distance / steps, 0, 0});
  }
  return drive;
}

/// Drives once around the ring and on to the next corner.
inline std::vector<DrivenPose> ringDrive(double turnPerMetre) {
  return driveAlong(ring(), {{0, 0}, {31.5, 0}, {31.5, 21}, {-1.5, 21}, {-1.5, 0}, {31.5, 0}}, turnPerMetre);
}

/// Returns the scan as it would be in a log.
inline Scans observed(const LaserScan& seen) {
  auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>();
  scan->aperture = static_cast<float>(M_PI);
  scan->timestamp = seen.timestamp;  // MRPT's default is now
  scan->maxRange = 80;
  scan->sensorPose = mrpt::poses::CPose3D(mrpt::math::TPose3D(seen.sensorPose));
  scan->resizeScan(seen.beams.size());
  for (size_t i = 0; i < seen.beams.size(); ++i) {
    scan->setScanRange(i, static_cast<float>(seen.beams[i].range));
    scan->setScanRangeValidity(i, seen.beams[i].valid);
  }
  return {scan};
}

}  // namespace hybrid_slam::test
