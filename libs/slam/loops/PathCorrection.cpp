#include "slam/loops/PathCorrection.h"

#include "base/PoseOffset.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

std::vector<TPose2D> corrected(const std::vector<TPose2D>& path, const std::vector<size_t>& nodes,
                               const std::vector<TPose2D>& moved) {
  std::vector<TPose2D> result = path;
  for (size_t k = 0; k < nodes.size(); ++k) {
    const size_t from = nodes[k], to = k + 1 < nodes.size() ? nodes[k + 1] : path.size();
    const auto carried = [&](size_t i) { return moved[k] + (path[i] - path[from]); };
    Eigen::Vector3d error = Eigen::Vector3d::Zero();
    if (to < path.size()) error = offsetOf(moved[k + 1], carried(to));
    for (size_t i = from; i < to; ++i) {
      const double share = static_cast<double>(i - from) / static_cast<double>(to - from);
      result[i] = displaced(carried(i), share * error);
    }
  }
  return result;
}

}  // namespace hybrid_slam
