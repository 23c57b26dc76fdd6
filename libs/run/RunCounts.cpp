#include "run/RunCounts.h"

#include <algorithm>

#include "base/Numbers.h"

namespace hybrid_slam::run {

void RunCounts::add(double timestamp, const FilterStep& step) {
  particlesMin = particlesMin == 0 ? step.particles : std::min(particlesMin, step.particles);
  particlesMax = std::max(particlesMax, step.particles);
  resamplings += step.resampled.value_or(false) ? 1 : 0;
  loops += step.loop ? 1 : 0;
  if (step.slipped.value_or(false) && slips++ == 0) firstSlip = timestamp;
}

std::vector<std::string> RunCounts::warnings() const {
  std::vector<std::string> lines;
  const auto warn = [&lines](const std::string& what, double first) {
    lines.push_back(what + ": first at " + fixedText(first, 3) + " s; scan matching replaced it");
  };
  if (slips > 0) warn(counted(slips, "update(s) with rejected odometry"), firstSlip);
  if (stuckScans > 0)
    warn(counted(stuckScans, "scan(s) with odometry that stood still while the robot moved"), firstStuck);
  return lines;
}

}  // namespace hybrid_slam::run
