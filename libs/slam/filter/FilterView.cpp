#include "slam/filter/FilterView.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

void setSpread(FilterStep& step, const std::vector<WeightedPose>& poses, double heading) {
  if (poses.empty()) return;
  const double best =
      std::max_element(poses.begin(), poses.end(), [](const WeightedPose& a, const WeightedPose& b) {
        return a.logWeight < b.logWeight;
      })->logWeight;
  double sum = 0, x = 0, y = 0, c = 0, s = 0;
  for (const auto& [pose, logWeight] : poses) {
    const double w = std::exp(logWeight - best);
    sum += w, x += w * pose.x, y += w * pose.y, c += w * std::cos(pose.phi), s += w * std::sin(pose.phi);
  }
  x /= sum, y /= sum;
  const double phi = std::atan2(s, c), cosH = std::cos(heading), sinH = std::sin(heading);
  double xx = 0, yy = 0, pp = 0, along = 0, across = 0;
  for (const auto& [pose, logWeight] : poses) {
    const double w = std::exp(logWeight - best) / sum;
    const double dx = pose.x - x, dy = pose.y - y, dPhi = mrpt::math::wrapToPi(pose.phi - phi);
    xx += w * dx * dx, yy += w * dy * dy, pp += w * dPhi * dPhi;
    along += w * std::pow(cosH * dx + sinH * dy, 2);
    across += w * std::pow(-sinH * dx + cosH * dy, 2);
  }
  step.stdX = std::sqrt(xx), step.stdY = std::sqrt(yy), step.stdPhi = std::sqrt(pp);
  step.stdAlong = std::sqrt(along), step.stdAcross = std::sqrt(across);
  step.poses = poses;
}

std::string describe(const Place& place) {
  if (place.isKnown) return "localised";
  return (place.wasKnown ? "place lost: " : "start unknown: ") + std::to_string(place.hypotheses) +
         " hypotheses";
}

}  // namespace hybrid_slam
