/// @file OrthoState.h
/// @brief State of the orthogonal line SLAM: an extended Kalman filter over the pose and one offset per line.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>

#include "slam/motion/MotionModel.h"

namespace hybrid_slam {

/// Normal distribution of the robot's pose (x, y, phi) and of the offsets c of lines x = c or y = c, all in
/// the frame of the building (m, rad), whose axes are parallel to its walls.
class OrthoState {
 public:
  /// A linear measurement of the state.
  struct Measurement {
    double innovation = 0;    ///< measured - predicted (m or rad)
    Eigen::VectorXd byState;  ///< derivative of the prediction with respect to the state
    double variance = 0;
  };

  mrpt::math::TPose2D pose() const { return {mean_[0], mean_[1], mean_[2]}; }
  Eigen::Matrix3d poseCovariance() const { return covariance_.topLeftCorner<3, 3>(); }
  size_t lines() const { return static_cast<size_t>(mean_.size()) - kPose; }
  double offset(size_t line) const { return mean_[index(line)]; }

  /// The place of a line in the state vector.
  static Eigen::Index index(size_t line) { return static_cast<Eigen::Index>(kPose + line); }
  /// A measurement without derivatives.
  Measurement measurement(double innovation, double variance) const;
  /// innovation^2 over its variance: the squared Mahalanobis distance.
  double squaredDistance(const Measurement& measurement) const;

  /// Prediction by the motion model. @param odometry  in the robot frame at the start of the step (m, rad)
  void move(const mrpt::math::TPose2D& odometry, const MotionModelOptions& model);
  /// Turns the frame about its origin while there are no lines. @param variance  of the angle, rad^2
  void turnFrame(double angle, double variance);
  void correct(const Measurement& measurement);
  /// Appends a line whose offset is a function of the pose.
  /// @param variance  of the measurement of the line from the pose, m^2
  void add(double offset, const Eigen::Vector3d& byPose, double variance);
  void remove(size_t line);

 private:
  static constexpr size_t kPose = 3;
  Eigen::VectorXd mean_ = Eigen::VectorXd::Zero(kPose);
  Eigen::MatrixXd covariance_ = Eigen::MatrixXd::Zero(kPose, kPose);
};

}  // namespace hybrid_slam
