#include "slam/ortho/OrthoState.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "base/PoseRotation.h"

namespace hybrid_slam {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using mrpt::math::TPose2D;

OrthoState::Measurement OrthoState::measurement(double innovation, double variance) const {
  return {innovation, VectorXd::Zero(mean_.size()), variance};
}

double OrthoState::squaredDistance(const Measurement& m) const {
  const double variance = m.byState.dot(covariance_ * m.byState) + m.variance;
  return m.innovation * m.innovation / variance;
}

void OrthoState::move(const TPose2D& odometry, const MotionModelOptions& model) {
  const MotionDistribution moved = motionDistribution(pose(), odometry, model);
  Eigen::Matrix3d byPose = Eigen::Matrix3d::Identity();
  byPose(0, 2) = mean_[1] - moved.mean.y;
  byPose(1, 2) = moved.mean.x - mean_[0];
  mean_.head<3>() << moved.mean.x, moved.mean.y, mrpt::math::wrapToPi(moved.mean.phi);
  covariance_.topRows<3>() = byPose * covariance_.topRows<3>();
  covariance_.leftCols<3>() = covariance_.leftCols<3>() * byPose.transpose();
  covariance_.topLeftCorner<3, 3>() += moved.covariance;
}

void OrthoState::turnFrame(double angle, double variance) {
  const TPose2D turned = TPose2D(0, 0, -angle) + pose();
  mean_.head<3>() << turned.x, turned.y, turned.phi;
  covariance_ = rotated(covariance_, -angle);
  covariance_(2, 2) += variance;
}

void OrthoState::correct(const Measurement& m) {
  const VectorXd cross = covariance_ * m.byState;
  const VectorXd gain = cross / (m.byState.dot(cross) + m.variance);
  mean_ += gain * m.innovation;
  mean_[2] = mrpt::math::wrapToPi(mean_[2]);
  covariance_ -= gain * cross.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();  // rounding
}

void OrthoState::add(double offset, const Eigen::Vector3d& byPose, double variance) {
  const Index size = mean_.size();
  const VectorXd cross = covariance_.leftCols<3>() * byPose;
  mean_.conservativeResize(size + 1);
  mean_[size] = offset;
  covariance_.conservativeResize(size + 1, size + 1);
  covariance_.col(size).head(size) = cross;
  covariance_.row(size).head(size) = cross.transpose();
  covariance_(size, size) = byPose.dot(cross.head<3>()) + variance;
}

void OrthoState::remove(size_t line) {
  const Index size = mean_.size(), from = index(line), rest = size - from - 1;
  mean_.segment(from, rest) = mean_.tail(rest).eval();
  covariance_.middleRows(from, rest) = covariance_.bottomRows(rest).eval();
  covariance_.middleCols(from, rest) = covariance_.rightCols(rest).eval();
  mean_.conservativeResize(size - 1);
  covariance_.conservativeResize(size - 1, size - 1);
}

}  // namespace hybrid_slam
