/// @file LaserPose.h
/// @brief A laser pose stated by the user, in place of that of the log.
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>

namespace hybrid_slam::readings {

/// Parses the pose of a laser on the robot: `X, Y, YAW` or `X, Y, YAW, ROLL` (m, deg). ROLL is 0, or 180 for
/// a laser mounted upside down. Returns empty for `auto`.
/// @throws InputError for another text, and for a laser over kMaxSensorDistance from the robot
std::optional<mrpt::poses::CPose3D> laserPoseIn(const std::string& text);

}  // namespace hybrid_slam::readings
