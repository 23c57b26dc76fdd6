#include "study/evaluation/PlanComparison.h"

#include <algorithm>
#include <cmath>

#include "study/evaluation/StampIndex.h"
#include "study/evaluation/WallSearch.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPoint2D;

constexpr double kStep = 0.02;        // m, pieces of a wall
constexpr double kSeenWithin = 0.05;  // m
constexpr int kLeastEnds = 3;

double lengthOf(const std::vector<PlanLine>& walls) {
  double sum = 0;
  for (const PlanLine& wall : walls) sum += (wall.end - wall.start).norm();
  return sum;
}

/// Returns the median; for an even number of values, the upper of the two middle ones; 0 if there are none.
double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double percent(size_t part, size_t whole) {
  return whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// Returns whether enough end points are near each point.
std::vector<bool> seen(const std::vector<WallPoint>& points, const std::vector<TPoint2D>& ends) {
  PointIndex index(kSeenWithin);
  for (size_t i = 0; i < points.size(); ++i) index.add(points[i].at, static_cast<int>(i));
  std::vector<int> count(points.size(), 0);
  for (const TPoint2D& end : ends)
    index.near(end, [&](int i) {
      const auto point = static_cast<size_t>(i);
      if (count[point] < kLeastEnds && (points[point].at - end).norm() <= kSeenWithin) ++count[point];
    });
  std::vector<bool> result;
  for (const int n : count) result.push_back(n >= kLeastEnds);
  return result;
}

}  // namespace

std::vector<TPoint2D> placedEndPoints(const std::vector<readings::EndPoints>& scans,
                                      const files::Trajectory& reference) {
  StampSequence rows(reference, kTimeTolerance);
  std::vector<TPoint2D> placed;
  for (const readings::EndPoints& scan : scans)
    if (const auto row = rows.next(scan.timestamp))
      for (const TPoint2D& p : scan.points) placed.push_back(reference[*row].pose.composePoint(p));
  return placed;
}

PlanErrors comparePlans(const std::vector<PlanLine>& plan, const std::vector<PlanLine>& truth,
                        const std::vector<TPoint2D>& ends, const AgreementOptions& options) {
  PlanErrors errors;
  errors.truth = lengthOf(truth);
  errors.plan = lengthOf(plan);

  const std::vector<WallPoint> truePoints = pointsOn(truth, kStep), planPoints = pointsOn(plan, kStep);
  const WallSearch inPlan(plan, options), inTruth(truth, options);
  const std::vector<bool> isSeen = seen(truePoints, ends);
  size_t found = 0, foundSeen = 0, allSeen = 0;
  for (size_t i = 0; i < truePoints.size(); ++i) {
    const bool isFound = inPlan.nearest(truePoints[i]).has_value();
    found += isFound;
    foundSeen += isFound && isSeen[i];
    allSeen += isSeen[i];
  }
  errors.found = percent(found, truePoints.size());
  errors.seen = errors.truth * percent(allSeen, truePoints.size()) / 100;
  if (!ends.empty()) errors.foundOfSeen = percent(foundSeen, allSeen);

  std::vector<double> distances, angles;
  for (const WallPoint& point : planPoints)
    if (const auto match = inTruth.nearest(point)) {
      distances.push_back(match->offset);
      angles.push_back(match->angle);
    }
  errors.wrong = percent(planPoints.size() - distances.size(), planPoints.size());
  errors.medianDistance = median(std::move(distances));
  errors.medianAngle = median(std::move(angles));
  return errors;
}

std::vector<PlanLine> moved(std::vector<PlanLine> walls, const mrpt::math::TPose2D& by) {
  for (PlanLine& wall : walls) wall = {by.composePoint(wall.start), by.composePoint(wall.end)};
  return walls;
}

}  // namespace hybrid_slam::evaluation
