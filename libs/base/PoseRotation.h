/// @file PoseRotation.h
/// @brief Rotation of covariances of a pose.
#pragma once

#include <Eigen/Geometry>

namespace hybrid_slam {

/// Returns the matrix that rotates x and y of (x, y, phi) by `angle` (rad).
inline Eigen::Matrix3d poseRotation(double angle) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return rotation;
}

/// Returns the covariance of (x, y, phi) in axes turned by -`angle` (rad), as after a rotation of the pose.
inline Eigen::Matrix3d rotated(const Eigen::Matrix3d& covariance, double angle) {
  const Eigen::Matrix3d rotation = poseRotation(angle);
  return rotation * covariance * rotation.transpose();
}

}  // namespace hybrid_slam
