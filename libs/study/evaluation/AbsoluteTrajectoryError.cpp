#include "study/evaluation/AbsoluteTrajectoryError.h"

#include <cmath>

#include "base/Errors.h"

namespace hybrid_slam::evaluation {

AteErrors absoluteTrajectoryError(const files::Trajectory& estimate, const files::Trajectory& reference,
                                  double tolerance) {
  const std::vector<PosePair> pairs = associate(estimate, reference, tolerance);
  if (pairs.size() < 2)
    throw InputError("only one common pose",
                     "trajectory " + timeSpan(estimate) + ", reference " + timeSpan(reference),
                     "expected at least 2, to align the trajectories");
  AteErrors result;
  result.pairs = pairs.size();
  result.alignment = rigidAlignment(pairs);
  std::vector<double> errors;
  for (const PosePair& pair : pairs) {
    const mrpt::math::TPose2D aligned = result.alignment + pair.estimate;
    errors.push_back(std::hypot(aligned.x - pair.reference.x, aligned.y - pair.reference.y));
  }
  result.translation = errorStatistics(std::move(errors));
  return result;
}

mrpt::math::TPose2D rigidAlignment(const std::vector<PosePair>& pairs) {
  const double n = static_cast<double>(pairs.size());
  double ex = 0, ey = 0, rx = 0, ry = 0;  // centroids
  for (const PosePair& pair : pairs) {
    ex += pair.estimate.x / n;
    ey += pair.estimate.y / n;
    rx += pair.reference.x / n;
    ry += pair.reference.y / n;
  }
  double dot = 0, cross = 0;  // of estimated and reference positions about their centroids
  for (const PosePair& pair : pairs) {
    const double ax = pair.estimate.x - ex, ay = pair.estimate.y - ey;
    const double bx = pair.reference.x - rx, by = pair.reference.y - ry;
    dot += ax * bx + ay * by;
    cross += ax * by - ay * bx;
  }
  const double phi = std::atan2(cross, dot), c = std::cos(phi), s = std::sin(phi);
  return {rx - (c * ex - s * ey), ry - (s * ex + c * ey), phi};
}

}  // namespace hybrid_slam::evaluation
