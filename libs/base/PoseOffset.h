/// @file PoseOffset.h
/// @brief Differences of poses in fixed axes, not in those of the robot.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Core>

namespace hybrid_slam {

/// Returns (x, y, phi) of a pose minus those of another one: m, m, rad in [-pi, pi].
inline Eigen::Vector3d offsetOf(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& from) {
  return {pose.x - from.x, pose.y - from.y, mrpt::math::wrapToPi(pose.phi - from.phi)};
}

/// Returns the pose with an offset (m, m, rad) added; its heading is in [-pi, pi].
inline mrpt::math::TPose2D displaced(const mrpt::math::TPose2D& pose, const Eigen::Vector3d& by) {
  return {pose.x + by.x(), pose.y + by.y(), mrpt::math::wrapToPi(pose.phi + by.z())};
}

}  // namespace hybrid_slam
