/// @file LogDensity.h
/// @brief The logarithm of a density of the pose, and its local quadratic form.
#pragma once

#include <Eigen/Dense>

namespace hybrid_slam {

/// ln of a density of the pose (x, y, phi), with the gradient and the (negative, at least semi-definite)
/// second derivative of its local quadratic form.
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
