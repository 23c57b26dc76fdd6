#include "slam/localization/PlanFit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/PointIndex.h"
#include "base/Segments.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kReach = 1;                           // m: farthest wall of a point
constexpr double kVoxel = 0.25;                        // m: side of a square of which one point is used
constexpr double kSigma = 0.05;                        // m per metre of wall: error of a plan
constexpr double kScaleSigma = 0.02;                   // a priori
constexpr double kMostStretched = 0.1, kFarthest = 1;  // m: beyond, the fit has failed
constexpr int kIterations = 30;

TPoint2D nearestOn(const PlanLine& wall, const TPoint2D& p) {
  return nearestOnSegment(p, wall.start, wall.end);
}

/// An index of the walls around the points; it omits the rest of a large plan.
class Walls {
 public:
  Walls(const std::vector<PlanLine>& walls, const TPoint2D& centre, double radius)
      : walls_(walls), index_(kReach) {
    for (size_t i = 0; i < walls.size(); ++i)
      if ((nearestOn(walls[i], centre) - centre).norm() < radius)
        addWithin(walls[i], centre, radius, static_cast<int>(i));
  }
  const PlanLine* nearestTo(const TPoint2D& p) const {
    const PlanLine* best = nullptr;
    double least = kReach;
    index_.near(p, [&](int i) {
      const PlanLine& wall = walls_[static_cast<size_t>(i)];
      const double distance = (nearestOn(wall, p) - p).norm();
      if (distance < least) least = distance, best = &wall;
    });
    return best;
  }

 private:
  void addWithin(const PlanLine& wall, const TPoint2D& centre, double radius, int i) {
    const TPoint2D d = wall.end - wall.start, middle = nearestOn(wall, centre);
    const TPoint2D step = d * (radius / d.norm());
    index_.add(nearestOn(wall, middle - step), nearestOn(wall, middle + step), i);
  }

  const std::vector<PlanLine>& walls_;
  PointIndex index_;
};

}  // namespace

double PlanFit::share() const {
  const auto count = std::count(isOnWall.begin(), isOnWall.end(), true);
  return static_cast<double>(count) / static_cast<double>(std::max<size_t>(1, isOnWall.size()));
}

std::vector<TPoint2D> thinned(const std::vector<TPoint2D>& points) {
  std::set<std::pair<long, long>> taken;
  std::vector<TPoint2D> result;
  for (const TPoint2D& p : points)
    if (taken.emplace(std::lround(p.x / kVoxel), std::lround(p.y / kVoxel)).second) result.push_back(p);
  return result;
}

PlanFit fitPlan(const std::vector<TPoint2D>& points, const std::vector<PlanLine>& walls,
                const PlanFit& first) {
  const std::vector<TPoint2D> chosen = thinned(points);
  double radius = 0;
  for (const TPoint2D& p : chosen) radius = std::max(radius, p.norm());
  // In the plan as drawn, the points shrink as the plan grows: p -> at + R p / scale.
  const TPoint2D start = TPoint2D(first.pose.x, first.pose.y) * (1 / first.scale);
  TPoint2D at = start;
  double phi = first.pose.phi, scale = first.scale;
  const Walls near(walls, start, radius * 1.1 + 2 * kReach);
  for (int i = 0; i < kIterations; ++i) {
    // The kernel narrows from the error of the first pose to that of the plan.
    const double width = std::max(3 * kSigma, 0.5 * std::pow(0.8, i));
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();  // of x, y, phi, scale
    Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
    information.diagonal() << 1, 1, 1, 1 / (kScaleSigma * kScaleSigma);  // what no point constrains stays
    gradient[3] = (1 - scale) * information(3, 3);
    const double c = std::cos(phi), s = std::sin(phi);
    for (const TPoint2D& p : chosen) {
      const TPoint2D turned((c * p.x - s * p.y) / scale, (s * p.x + c * p.y) / scale), q = at + turned;
      const PlanLine* wall = near.nearestTo(q);
      if (!wall) continue;
      const TPoint2D off = q - nearestOn(*wall, q);
      const double u = off.norm() / width;
      if (u >= 1) continue;
      const TPoint2D d = (wall->end - wall->start) * (1 / (wall->end - wall->start).norm()), n(-d.y, d.x);
      const double weight = kVoxel * (1 - u * u) * (1 - u * u) / (kSigma * kSigma);  // Tukey's biweight
      const double across = n.x * turned.x + n.y * turned.y;
      const Eigen::Vector4d slope(n.x, n.y, n.y * turned.x - n.x * turned.y, -across / scale);
      information += weight * slope * slope.transpose();
      gradient -= weight * (n.x * off.x + n.y * off.y) * slope;
    }
    const Eigen::Vector4d step = information.ldlt().solve(gradient);
    at += TPoint2D(step[0], step[1]), phi += step[2], scale += step[3];
    if (!(std::abs(scale - 1) < kMostStretched && (at - start).norm() < kFarthest))
      return {first.pose, first.scale, std::vector<bool>(chosen.size())};
  }
  PlanFit fit{{at.x * scale, at.y * scale, std::remainder(phi, 2 * M_PI)}, scale};
  const TPose2D drawn(at.x, at.y, phi);
  for (const TPoint2D& p : chosen) {
    const TPoint2D q = drawn.composePoint(p * (1 / scale));
    const PlanLine* wall = near.nearestTo(q);
    fit.isOnWall.push_back(wall && (q - nearestOn(*wall, q)).norm() < 3 * kSigma);
  }
  return fit;
}

}  // namespace hybrid_slam
