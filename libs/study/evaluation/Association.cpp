#include "study/evaluation/Association.h"

#include <algorithm>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::evaluation {

std::vector<PosePair> associate(const files::Trajectory& estimate, const files::Trajectory& reference,
                                double tolerance) {
  StampSequence rows(reference, tolerance);
  std::vector<PosePair> pairs;
  for (size_t i = 0; i < estimate.size(); ++i)
    if (const auto row = rows.next(estimate[i].timestamp))
      pairs.push_back({estimate[i].timestamp, estimate[i].pose, reference[*row].pose, i, *row});
  if (pairs.empty())
    throw InputError("the reference does not overlap the trajectory in time",
                     "trajectory " + timeSpan(estimate) + ", reference " + timeSpan(reference),
                     "expected poses within " + numberText(tolerance) + " s of each other");
  return pairs;
}

std::string timeSpan(const files::Trajectory& trajectory) {
  if (trajectory.empty()) return "without poses";
  const auto [first, last] = std::minmax_element(
      trajectory.begin(), trajectory.end(),
      [](const files::StampedPose& a, const files::StampedPose& b) { return a.timestamp < b.timestamp; });
  return fixedText(first->timestamp, 3) + ".." + fixedText(last->timestamp, 3) + " s";
}

}  // namespace hybrid_slam::evaluation
