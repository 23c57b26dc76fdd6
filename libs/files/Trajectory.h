/// @file Trajectory.h
/// @brief Timed planar poses and their files.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace hybrid_slam::files {

/// A pose and its time.
struct StampedPose {
  double timestamp = 0;        ///< s
  mrpt::math::TPose2D pose{};  ///< of the robot, in the frame of the trajectory; m, rad
};

/// Poses in the order of driving, as in the file. Timestamps may repeat or decrease.
using Trajectory = std::vector<StampedPose>;

/// Reads `timestamp x y z qx qy qz qw` (s, m, unit quaternion): keeps x, y and yaw.
/// @throws InputError for an unreadable or empty file, a broken line, a coordinate beyond 10,000 km or a
///         quaternion not of unit length.
Trajectory loadTum(const std::string& file);

/// Writes the TUM format, rounded to 1e-6 s, 1e-9 m and 1e-9 in the quaternion.
void saveTum(const Trajectory& trajectory, std::ostream& out);

/// Reads raw odometry, `t x y theta` (s, m, rad).
/// @throws InputError for an unreadable or empty file, a broken line, a coordinate beyond 10,000 km or
///         an angle beyond 1e7 rad.
Trajectory loadOdometry(const std::string& file);

}  // namespace hybrid_slam::files
