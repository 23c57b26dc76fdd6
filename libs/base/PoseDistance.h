/// @file PoseDistance.h
/// @brief Distances between poses and along a path.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>
#include <vector>

namespace hybrid_slam {

/// Returns the distance of the positions, m.
inline double distanceBetween(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Returns the difference of the headings, rad, in [0, pi].
inline double angleBetween(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) {
  return std::abs(mrpt::math::wrapToPi(a.phi - b.phi));
}

/// Returns whether the poses are closer than `distance` (m) and `angle` (rad).
inline bool isWithin(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b, double distance,
                     double angle) {
  return distanceBetween(a, b) < distance && angleBetween(a, b) < angle;
}

/// Returns the length of the path up to each of its poses, m.
inline std::vector<double> lengthsAlong(const std::vector<mrpt::math::TPose2D>& path) {
  std::vector<double> lengths(path.size());
  for (size_t i = 1; i < path.size(); ++i)
    lengths[i] = lengths[i - 1] + distanceBetween(path[i - 1], path[i]);
  return lengths;
}

}  // namespace hybrid_slam
