/// @file TestLines.h
/// @brief For the tests: points along lines, random lines, the errors of lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/lines/LineSegment.h"
#include "slam/lines/Segmentation.h"
#include "testing/TestScans.h"

namespace hybrid_slam::test {

inline PointRange range(const std::vector<TPoint2D>& points) {
  return {points.data(), points.data() + points.size()};
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
