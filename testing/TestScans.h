/// @file TestScans.h
/// @brief For the tests: scans of hand-made walls, points along lines, random lines.
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/LaserScan.h"
#include "base/RandomStream.h"
#include "slam/lines/LineSegment.h"
#include "slam/lines/Segmentation.h"

namespace hybrid_slam::test {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kDegree = mrpt::DEG2RAD(1.0);
using Walls = std::vector<std::pair<TPoint2D, TPoint2D>>;

inline PointRange range(const std::vector<TPoint2D>& points) {
  return {points.data(), points.data() + points.size()};
}

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

inline LineSegment randomSegment(RandomStream& random, double reach) {
  return makeSegment(TPoint2D(uniform(random, -reach, reach), uniform(random, -reach, reach)),
                     TPoint2D(uniform(random, -reach, reach), uniform(random, -reach, reach)));
}

/// `n` points on x cos(theta) + y sin(theta) = rho, evenly from `from` to `to` m from the foot of the
/// perpendicular, each with `noise` m (1 sigma) across the line.
inline std::vector<TPoint2D> pointsOnLine(double rho, double theta, double from, double to, int n,
                                          double noise, RandomStream& random) {
  std::vector<TPoint2D> points;
  for (int i = 0; i < n; ++i) {
    const double along = from + (to - from) * i / (n - 1), off = rho + noise * random.gaussian();
    points.emplace_back(off * std::cos(theta) - along * std::sin(theta),
                        off * std::sin(theta) + along * std::cos(theta));
  }
  return points;
}

/// Angle between two lines, rad, in [0, pi/2].
inline double angleBetween(double theta1, double theta2) {
  return std::abs(std::remainder(theta1 - theta2, M_PI));
}

/// Distance between two lines, compared in the representation with agreeing normals.
inline double lineDistance(double rho1, double theta1, double rho2, double theta2) {
  const double sign = std::cos(theta1 - theta2) < 0 ? -1 : 1;
  return std::max(std::abs(rho1 - sign * rho2), angleBetween(theta1, theta2));
}

struct Spread {
  double median = 0, rms = 0;
};

inline Spread spread(std::vector<double> values) {
  Spread result;
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  result.median = values[values.size() / 2];
  for (const double v : values) result.rms += v * v;
  result.rms = std::sqrt(result.rms / static_cast<double>(values.size()));
  return result;
}

}  // namespace hybrid_slam::test
