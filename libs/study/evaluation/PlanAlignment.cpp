// The rigid motion of a plan onto the truth.
#include <mrpt/core/bits_math.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "slam/lines/WallDirections.h"
#include "study/evaluation/PlanComparison.h"
#include "study/evaluation/WallSearch.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kAlignedStep = 0.1;  // m, pieces of a wall
constexpr double kCell = 0.05;        // m, of the offsets' histograms
constexpr double kMostCells = 4000;

double directionOf(const std::vector<PlanLine>& walls) {
  std::vector<LineSegment> segments;
  for (const PlanLine& wall : walls) segments.push_back(makeSegment(wall.start, wall.end));
  return directionModuloRightAngle(segments).value_or(0);
}

/// Histogram of the walls' length by their offset along one axis (0: x, 1: y).
struct Offsets {
  std::vector<double> length;
  double first = 0;  ///< m

  Offsets(const std::vector<WallPoint>& points, int axis, double cell) {
    const auto value = [axis](const TPoint2D& p) { return axis == 0 ? p.x : p.y; };
    double low = 1e9, high = -1e9;
    for (const WallPoint& point : points)
      low = std::min(low, value(point.at)), high = std::max(high, value(point.at));
    first = low;
    length.assign(static_cast<size_t>((high - low) / cell) + 1, 0);
    for (const WallPoint& point : points) {
      const double across = std::abs(axis == 0 ? std::sin(point.angle) : std::cos(point.angle));
      if (across > 0.9) length[static_cast<size_t>((value(point.at) - low) / cell)] += kAlignedStep;
    }
  }
};

/// Returns the shift of the plan (m) at which the offsets of both agree best.
double bestShift(const std::vector<WallPoint>& plan, const std::vector<WallPoint>& truth, int axis,
                 double cell) {
  const Offsets a(plan, axis, cell), b(truth, axis, cell);
  const auto na = static_cast<int>(a.length.size()), nb = static_cast<int>(b.length.size());
  double most = -1;
  int best = 0;
  for (int shift = -na; shift <= nb; ++shift) {
    double sum = 0;
    for (int i = std::max(0, -shift); i < na && i + shift < nb; ++i) {
      const auto j = static_cast<size_t>(i + shift);
      sum += std::min(a.length[static_cast<size_t>(i)], b.length[j]);
    }
    if (sum > most) most = sum, best = shift;
  }
  return b.first - a.first + best * cell;
}

struct Fit {
  TPose2D pose;
  size_t agreeing = 0;
};

/// Refines the pose by Gauss-Newton on the distances to the nearest walls.
Fit refined(TPose2D pose, const std::vector<WallPoint>& plan, const WallSearch& search) {
  Fit fit{pose};
  for (int pass = 0; pass < 20; ++pass) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Identity() * 1e-6;
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    fit.agreeing = 0;
    for (const WallPoint& point : plan) {
      const TPoint2D p = fit.pose.composePoint(point.at);
      const auto match = search.nearest({p, point.angle + fit.pose.phi});
      if (!match) continue;
      ++fit.agreeing;
      const TPoint2D d = match->nearest - p;
      if (d.norm() < 1e-9) continue;
      const TPoint2D n(-std::sin(point.angle + fit.pose.phi), std::cos(point.angle + fit.pose.phi));
      const Eigen::Vector3d row(n.x, n.y, n.y * (p.x - fit.pose.x) - n.x * (p.y - fit.pose.y));
      a += row * row.transpose();
      b += row * (n.x * d.x + n.y * d.y);
    }
    const Eigen::Vector3d step = a.ldlt().solve(b);
    fit.pose = TPose2D(fit.pose.x + step[0], fit.pose.y + step[1], fit.pose.phi + step[2]);
    if (step.norm() < 1e-7) break;
  }
  return fit;
}

/// The middle of the walls' extent.
TPose2D middleOf(const std::vector<PlanLine>& walls) {
  TPoint2D low = walls.front().start, high = low;
  for (const PlanLine& wall : walls)
    for (const TPoint2D& p : {wall.start, wall.end}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  return {(low.x + high.x) / 2, (low.y + high.y) / 2, 0};
}

/// The motion of a plan onto the truth, both about the origin.
TPose2D alignmentNearOrigin(const std::vector<PlanLine>& plan, const std::vector<PlanLine>& truth) {
  const std::vector<WallPoint> points = pointsOn(plan, kAlignedStep),
                               truePoints = pointsOn(truth, kAlignedStep);
  const double frame = directionOf(truth), turn = frame - directionOf(plan);
  // The search runs in the truth's frame, turned so that its walls lie along the axes.
  const auto onAxes = [](std::vector<WallPoint> all, double by) {
    const TPose2D rotation(0, 0, by);
    for (WallPoint& p : all) p = {rotation.composePoint(p.at), p.angle + by};
    return all;
  };
  const std::vector<WallPoint> target = onAxes(truePoints, -frame);
  double extent = 0;
  for (const auto* all : {&points, &truePoints})
    for (const WallPoint& p : *all) extent = std::max({extent, std::abs(p.at.x), std::abs(p.at.y)});
  const double cell = std::max(kCell, 3 * extent / kMostCells);

  const WallSearch coarse(truth, {0.6, mrpt::DEG2RAD(10.0)}), fine(truth, {0.15, mrpt::DEG2RAD(5.0)});
  Fit best;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double heading = turn + quarter * M_PI / 2;
    const std::vector<WallPoint> turned = onAxes(points, heading - frame);
    const TPoint2D shift(bestShift(turned, target, 0, cell), bestShift(turned, target, 1, cell));
    const TPoint2D place = TPose2D(0, 0, frame).composePoint(shift);
    const Fit fit = refined(refined({place.x, place.y, heading}, points, coarse).pose, points, fine);
    if (quarter == 0 || fit.agreeing > best.agreeing) best = fit;
  }
  return best.pose;
}

}  // namespace

TPose2D alignmentOf(const std::vector<PlanLine>& plan, const std::vector<PlanLine>& truth) {
  if (plan.empty() || truth.empty()) return {};
  // A plan in the coordinates of a country is as large as its building.
  const TPose2D from = TPose2D() - middleOf(plan), to = middleOf(truth);
  TPose2D alignment = to + alignmentNearOrigin(moved(plan, from), moved(truth, TPose2D() - to)) + from;
  alignment.normalizePhi();
  return alignment;
}

}  // namespace hybrid_slam::evaluation
