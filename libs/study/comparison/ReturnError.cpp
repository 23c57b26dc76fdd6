#include "study/comparison/ReturnError.h"

#include <cmath>

#include "study/evaluation/Association.h"

namespace hybrid_slam::comparison {

ReturnError returnError(const files::Trajectory& estimate, const files::Trajectory& reference,
                        double tolerance) {
  const std::vector<evaluation::PosePair> pairs = evaluation::associate(estimate, reference, tolerance);
  const evaluation::PosePair &first = pairs.front(), &last = pairs.back();
  const auto error = (last.estimate - first.estimate) - (last.reference - first.reference);
  return {error.norm(), std::abs(error.phi)};
}

}  // namespace hybrid_slam::comparison
