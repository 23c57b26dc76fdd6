/// @file TestScans.h
/// @brief For the tests: scans of hand-made walls, random poses.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/Degree.h"
#include "base/LaserScan.h"
#include "base/RandomStream.h"

namespace hybrid_slam::test {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

using Walls = std::vector<std::pair<TPoint2D, TPoint2D>>;

/// Closed polygon.
inline Walls polygon(const std::vector<TPoint2D>& corners) {
  Walls walls;
  for (size_t i = 0; i < corners.size(); ++i)
    walls.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
  return walls;
}

/// Distance from `origin` to the nearest wall along `heading`; infinite if there is none.
inline double castRay(const Walls& walls, const TPoint2D& origin, double heading) {
  const double dx = std::cos(heading), dy = std::sin(heading);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : walls) {
    const double ex = b.x - a.x, ey = b.y - a.y, cross = dx * ey - dy * ex;
    if (std::abs(cross) < 1e-12) continue;
    const double t = ((a.x - origin.x) * ey - (a.y - origin.y) * ex) / cross;
    const double u = ((a.x - origin.x) * dy - (a.y - origin.y) * dx) / cross;
    if (t > 0 && u >= 0 && u <= 1) nearest = std::min(nearest, t);
  }
  return nearest;
}

/// Scan of a laser with `aperture` rad at `sensor` on a robot at `robot` (map frame).
inline LaserScan scanOf(const Walls& walls, const TPose2D& robot, const TPose2D& sensor, size_t beams,
                        double aperture, double noise, RandomStream& random) {
  LaserScan scan;
  scan.sensorPose = sensor;
  scan.maxRange = 20;
  const TPoint2D origin = robot.composePoint(TPoint2D(sensor.x, sensor.y));
  for (size_t i = 0; i < beams; ++i) {
    Beam beam;
    beam.angle = -0.5 * aperture + static_cast<double>(i) * aperture / static_cast<double>(beams - 1);
    beam.range = castRay(walls, origin, robot.phi + sensor.phi + beam.angle) + noise * random.gaussian();
    beam.valid = beam.range < scan.maxRange;
    scan.beams.push_back(beam);
  }
  return scan;
}

inline double uniform(RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

inline TPose2D randomPose(RandomStream& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -M_PI, M_PI)};
}

}  // namespace hybrid_slam::test
