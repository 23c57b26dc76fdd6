#include "slam/features/CircleFit.h"

#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;

namespace {

/// (x, y, radius), relative to the mean of the points.
using Circle = Eigen::Vector3d;

TPoint2D meanOf(PointRange points) {
  TPoint2D mean(0, 0);
  for (const TPoint2D& p : points) mean += p;
  return mean * (1.0 / static_cast<double>(points.size()));
}

/// Fits a (x^2 + y^2) + b x + c y + d = 0 by least squares under Taubin's constraint: the eigenvector of the
/// normalised moments with the least eigenvalue (Chernov 2010).
std::optional<Circle> taubin(PointRange points, const TPoint2D& mean) {
  double meanSquare = 0;
  for (const TPoint2D& p : points) meanSquare += (p - mean).sqrNorm();
  meanSquare /= static_cast<double>(points.size());
  if (!(meanSquare > 0)) return std::nullopt;
  const double scale = 2 * std::sqrt(meanSquare);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const TPoint2D& p : points) {
    const TPoint2D at = p - mean;
    const Eigen::Vector3d row((at.sqrNorm() - meanSquare) / scale, at.x, at.y);
    moments += row * row.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  const Eigen::Vector3d least = solver.eigenvectors().col(0);
  const double a = least[0] / scale, b = least[1], c = least[2], d = -meanSquare * a;
  if (std::abs(a) * std::sqrt(meanSquare) < 1e-6) return std::nullopt;  // a line
  return Circle(-b / (2 * a), -c / (2 * a), std::sqrt(b * b + c * c - 4 * a * d) / (2 * std::abs(a)));
}

}  // namespace

std::optional<FittedCircle> fitCircle(PointRange points) {
  if (points.size() < 4) return std::nullopt;
  const TPoint2D mean = meanOf(points);
  auto circle = taubin(points, mean);
  if (!circle) return std::nullopt;
  FittedCircle fit;
  constexpr int kSteps = 3;
  for (int step = 0; step <= kSteps; ++step) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    fit.squares = 0;
    for (const TPoint2D& p : points) {
      const double dx = p.x - mean.x - circle->x(), dy = p.y - mean.y - circle->y(), r = std::hypot(dx, dy);
      if (r <= 0) return std::nullopt;
      const double distance = r - circle->z();
      const Eigen::Vector3d row(-dx / r, -dy / r, -1);
      normal += row * row.transpose();
      right -= distance * row;
      fit.squares += distance * distance;
    }
    const Eigen::LLT<Eigen::Matrix3d> factor(normal);
    if (factor.info() != Eigen::Success) return std::nullopt;
    fit.cofactor = factor.solve(Eigen::Matrix3d::Identity());
    if (step < kSteps) *circle += factor.solve(right);
  }
  if (!circle->allFinite() || !fit.cofactor.allFinite() || circle->z() <= 0) return std::nullopt;
  fit.centre = mean + TPoint2D(circle->x(), circle->y());
  fit.radius = circle->z();
  return fit;
}

}  // namespace hybrid_slam
