#include "slam/loops/PathCorrection.h"

#include <mrpt/math/wrap2pi.h>

namespace hybrid_slam {

using mrpt::math::TPose2D;

std::vector<TPose2D> corrected(const std::vector<TPose2D>& path, const std::vector<size_t>& nodes,
                               const std::vector<TPose2D>& moved) {
  std::vector<TPose2D> result = path;
  for (size_t k = 0; k < nodes.size(); ++k) {
    const size_t from = nodes[k], to = k + 1 < nodes.size() ? nodes[k + 1] : path.size();
    const auto carried = [&](size_t i) { return moved[k] + (path[i] - path[from]); };
    TPose2D error;
    if (to < path.size()) {
      const TPose2D end = carried(to);
      error = {moved[k + 1].x - end.x, moved[k + 1].y - end.y,
               mrpt::math::wrapToPi(moved[k + 1].phi - end.phi)};
    }
    for (size_t i = from; i < to; ++i) {
      const double share = static_cast<double>(i - from) / static_cast<double>(to - from);
      TPose2D pose = carried(i);
      pose.x += share * error.x, pose.y += share * error.y;
      pose.phi = mrpt::math::wrapToPi(pose.phi + share * error.phi);
      result[i] = pose;
    }
  }
  return result;
}

}  // namespace hybrid_slam
