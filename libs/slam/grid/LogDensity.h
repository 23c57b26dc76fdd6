/// @file LogDensity.h
/// @brief Log-density of the pose and its local quadratic approximation.
#pragma once

#include <Eigen/Dense>

namespace hybrid_slam {

/// Log-density of the pose (x, y, phi) with the gradient and the positive semi-definite information matrix of
/// its local quadratic approximation.
struct LogDensity {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< minus the second derivative

  LogDensity& operator+=(const LogDensity& other) {
    value += other.value, gradient += other.gradient, information += other.information;
    return *this;
  }
};

}  // namespace hybrid_slam
