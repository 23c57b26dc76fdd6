/// @file Trajectory.h
/// @brief Timed planar poses, and the files that hold them.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace hybrid_slam::files {

struct StampedPose {
  double timestamp = 0;        ///< s
  mrpt::math::TPose2D pose{};  ///< of the robot, in the frame of the trajectory; m, rad
};

/// In file order: that is the order in which the robot was at the poses; timestamps may repeat and step back.
using Trajectory = std::vector<StampedPose>;

/// Reads `timestamp x y z qx qy qz qw` (s, m, unit quaternion): x, y and the yaw, without height and tilt.
/// @throws InputError for an unreadable or empty file, a broken line, a quaternion that is not of length 1.
Trajectory loadTum(const std::string& file);

/// Writes the TUM form: 1e-6 s, 1e-9 m, 1e-9 in the quaternion.
void saveTum(const Trajectory& trajectory, std::ostream& out);

/// Reads raw odometry, `t x y theta` (s, m, rad).
/// @throws InputError for an unreadable or empty file or a broken line.
Trajectory loadOdometry(const std::string& file);

}  // namespace hybrid_slam::files
