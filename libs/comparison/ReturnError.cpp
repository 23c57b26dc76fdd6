#include "comparison/ReturnError.h"

#include <cmath>

#include "evaluation/Association.h"

namespace hybrid_slam {

ReturnError returnError(const Trajectory& estimate, const Trajectory& reference, double tolerance) {
  const std::vector<PosePair> pairs = associate(estimate, reference, tolerance);
  const PosePair &first = pairs.front(), &last = pairs.back();
  const auto error = (last.estimate - first.estimate) - (last.reference - first.reference);
  return {error.norm(), std::abs(error.phi)};
}

}  // namespace hybrid_slam
