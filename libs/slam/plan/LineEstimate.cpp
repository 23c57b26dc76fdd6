#include "slam/plan/LineEstimate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

/// Offset and angle of line b as linear functions of those of line a.
struct Innovation {
  Eigen::Matrix2d model, covariance;
  Eigen::Vector2d difference;
};

Innovation innovation(const LineEstimate& a, const LineEstimate& b) {
  Innovation result;
  result.model << 1, a.along(b.at), 0, 1;
  result.difference << a.offset(b.at), std::remainder(b.angle - a.angle, 2 * M_PI);
  result.covariance = result.model * a.covariance * result.model.transpose() + b.covariance;
  return result;
}

}  // namespace

double LineEstimate::along(const TPoint2D& p) const {
  return (p.x - at.x) * std::cos(angle) + (p.y - at.y) * std::sin(angle);
}

double LineEstimate::offset(const TPoint2D& p) const {
  return (p.y - at.y) * std::cos(angle) - (p.x - at.x) * std::sin(angle);
}

Eigen::Matrix2d LineEstimate::covarianceAt(const TPoint2D& p) const {
  const Eigen::Matrix2d& c = covariance;
  const double s = along(p), cross = c(0, 1) + s * c(1, 1);
  Eigen::Matrix2d result;
  result << c(0, 0) + 2 * s * c(0, 1) + s * s * c(1, 1), cross, cross, c(1, 1);
  return result;
}

LineEstimate LineEstimate::reversed() const {
  LineEstimate result = *this;
  result.angle = std::remainder(angle + M_PI, 2 * M_PI);
  result.covariance(0, 1) = result.covariance(1, 0) = -covariance(0, 1);
  return result;
}

LineEstimate lineThrough(const TPoint2D& middle, double angle, double length, double sigma) {
  LineEstimate line{middle, angle, Eigen::Matrix2d::Zero()};
  const double variance = sigma * sigma / (1 + length);
  line.covariance(0, 0) = variance;
  line.covariance(1, 1) = std::min(1.0, 12 * variance / std::max(length * length, 1e-4));
  return line;
}

double squaredDistance(const LineEstimate& a, const LineEstimate& b) {
  const Innovation i = innovation(a, b);
  return i.difference.dot(i.covariance.inverse() * i.difference);
}

LineEstimate fused(const LineEstimate& a, const LineEstimate& b) {
  const Innovation i = innovation(a, b);
  const Eigen::Matrix2d gain = a.covariance * i.model.transpose() * i.covariance.inverse();
  const Eigen::Vector2d moved = gain * i.difference;
  const Eigen::Matrix2d p = a.covariance - gain * i.model * a.covariance;

  LineEstimate result = a;
  result.at += TPoint2D(-std::sin(a.angle), std::cos(a.angle)) * moved[0];
  result.angle = std::remainder(a.angle + moved[1], 2 * M_PI);
  const double cross = (p(0, 1) + p(1, 0)) / 2;
  result.at = result.point(-cross / p(1, 1));
  result.covariance << p(0, 0) - cross * cross / p(1, 1), 0, 0, p(1, 1);
  return result;
}

LineEstimate turnedTo(const LineEstimate& line, double angle, double variance) {
  LineEstimate result = line;
  const double prior = line.covariance(1, 1), cross = line.covariance(0, 1);
  const double turn = std::remainder(angle - line.angle, 2 * M_PI);
  result.at += TPoint2D(-std::sin(line.angle), std::cos(line.angle)) * (cross / prior * turn);
  result.angle = angle;
  const double posterior = prior * variance / (prior + variance);
  result.covariance(0, 0) -= cross * cross / prior * (1 - posterior / prior);
  result.covariance(0, 1) = result.covariance(1, 0) = cross * posterior / prior;
  result.covariance(1, 1) = posterior;
  return result;
}

}  // namespace hybrid_slam
