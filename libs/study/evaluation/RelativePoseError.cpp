#include "study/evaluation/RelativePoseError.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "base/PoseDistance.h"
#include "study/evaluation/Association.h"

namespace hybrid_slam::evaluation {
namespace {

/// Time (s) or distance along the reference (m) at each pair; ascending.
std::vector<double> progressAlong(const std::vector<PosePair>& pairs, const files::Trajectory& reference,
                                  RpeDelta::Unit unit) {
  std::vector<double> result;
  if (unit == RpeDelta::Unit::seconds) {
    for (const PosePair& pair : pairs) result.push_back(pair.timestamp);
    return result;
  }
  std::vector<mrpt::math::TPose2D> path;
  for (const files::StampedPose& pose : reference) path.push_back(pose.pose);
  const std::vector<double> lengths = lengthsAlong(path);
  for (size_t i = 0; i < pairs.size(); ++i)
    result.push_back(i == 0 ? 0
                            : result.back() + std::abs(lengths[pairs[i].referenceRow] -
                                                       lengths[pairs[i - 1].referenceRow]));
  return result;
}

/// The index after i (not the last) whose progress is closest to the target.
size_t nearestAfter(const std::vector<double>& progress, size_t i, double target) {
  const auto first = std::next(progress.begin(), static_cast<std::ptrdiff_t>(i) + 1);
  auto nearest = std::lower_bound(first, progress.end(), target);
  if (nearest == progress.end() || (nearest != first && target - *std::prev(nearest) <= *nearest - target))
    --nearest;
  return static_cast<size_t>(nearest - progress.begin());
}

}  // namespace

RpeErrors relativePoseError(const files::Trajectory& estimate, const files::Trajectory& reference,
                            const RpeDelta& delta, double tolerance) {
  constexpr double kLengthTolerance = 0.1;  // of delta
  constexpr double kRounding = 1e-6;        // s or m; of timestamps in files
  std::vector<PosePair> pairs = associate(estimate, reference, tolerance);
  if (delta.unit == RpeDelta::Unit::seconds)
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const PosePair& a, const PosePair& b) { return a.timestamp < b.timestamp; });
  const std::vector<double> at = progressAlong(pairs, reference, delta.unit);

  std::vector<double> translations, rotations;
  for (size_t i = 0; i + 1 < pairs.size(); ++i) {
    const double target = at[i] + delta.length;
    if (at.back() < target - kRounding) break;  // end of the trajectory: all later pairs would be too short
    const size_t j = nearestAfter(at, i, target);
    if (std::abs(at[j] - target) > kLengthTolerance * delta.length) continue;
    const PosePair &first = pairs[i], &last = pairs[j];
    const mrpt::math::TPose2D error = (last.estimate - first.estimate) - (last.reference - first.reference);
    translations.push_back(std::hypot(error.x, error.y));
    rotations.push_back(std::abs(error.phi));
  }
  if (translations.empty()) {
    const char* const unit = delta.unit == RpeDelta::Unit::seconds ? " s" : " m";
    throw InputError("no pose pairs " + numberText(delta.length) + unit + " apart",
                     "trajectory " + timeSpan(estimate) + ", reference " + timeSpan(reference),
                     "expected two poses this far apart, within 10 %");
  }
  RpeErrors result;
  result.pairs = translations.size();
  result.translation = errorStatistics(std::move(translations));
  result.rotation = errorStatistics(std::move(rotations));
  return result;
}

}  // namespace hybrid_slam::evaluation
