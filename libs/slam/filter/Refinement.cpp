#include "slam/filter/Refinement.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "slam/filter/Threads.h"
#include "slam/grid/BeamSelection.h"
#include "slam/grid/NarrowThings.h"
#include "slam/grid/ScanMatcher.h"
#include "slam/loops/LoopCloser.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

/// Moves each run of scans that fit better elsewhere, unless the motions at its two ends then depart from the
/// odometry by more than before and 3 standard deviations.
void move(std::vector<PosedScans>& scans, const std::vector<std::optional<TPose2D>>& elsewhere,
          const std::vector<MotionDistribution>& odometry) {
  constexpr double kDeviations = 3;
  for (size_t first = 0, end; first < scans.size(); first = end + 1) {
    for (end = first; end < scans.size() && elsewhere[end];) ++end;
    if (end == first) continue;
    double increase = 0, variance = 0;  // m, m^2
    const auto addEnd = [&](size_t i, const TPose2D& from, const TPose2D& to) {
      const auto departure = [&](const TPose2D& motion) {
        return std::hypot(motion.x - odometry[i].mean.x, motion.y - odometry[i].mean.y);
      };
      increase += departure(to - from) - departure(scans[i + 1].pose - scans[i].pose);
      variance += odometry[i].covariance.topLeftCorner<2, 2>().trace();
    };
    if (first > 0) addEnd(first - 1, scans[first - 1].pose, *elsewhere[first]);
    if (end < scans.size()) addEnd(end - 1, *elsewhere[end - 1], scans[end].pose);
    if (increase > kDeviations * std::sqrt(variance)) continue;
    for (size_t i = first; i < end; ++i) scans[i].pose = *elsewhere[i];
  }
}

}  // namespace

std::vector<LoopClosure> closeLoops(std::vector<TPose2D>& path, const std::vector<Scans>& scans,
                                    const std::optional<double>& direction,
                                    const FilterConfiguration& configuration) {
  const ScanPreparation prepare(configuration);
  LoopCloser closer(configuration.loopClosing, configuration.grid);
  std::vector<LoopClosure> closures;
  for (size_t i = 0; i < scans.size(); ++i) {
    const LaserScans seen = toLaserScans(scans[i], configuration.grid.maxRange);
    closer.add(i > 0 ? path[i] - path[i - 1] : TPose2D(), seen, prepare.lines(seen), false);
    if (!closer.isDue()) continue;
    auto closure = closer.close(path, direction);
    if (!closure) continue;
    path = closure->path;
    closures.push_back(std::move(*closure));
  }
  return closures;
}

void refine(std::vector<PosedScans>& scans, int passes, const FilterConfiguration& configuration,
            const std::optional<ScanMap>& base, const std::vector<MotionDistribution>& odometry) {
  constexpr double kClearGain = 0.25;  // of ln p, per beam
  const Eigen::Vector3d deviations(0.05, 0.05, mrpt::DEG2RAD(1.0));
  const double minFit = configuration.improved.minFit;
  const ScanMatcher matcher(configuration.matcher);
  tbb::task_arena arena(arenaThreads(configuration.filter.threads));
  for (int pass = 0; pass < passes; ++pass) {
    const OccupancyGrid map = gridOf(scans, configuration.grid, base);
    std::vector<std::optional<TPose2D>> elsewhere(scans.size());
    parallelFor(arena, 0, scans.size(), [&](size_t i) {
      const LaserScans all = toLaserScans(scans[i].scans, configuration.grid.maxRange);
      const LaserScans seen = without(all, endsAtMovedThing(ScanBeams(all), scans[i].pose, map));
      const ScanBeams beams(seen, BeamSelection(seen).take(configuration.matcher.beams));
      ScanLikelihood likelihood = matcher.likelihood(beams, map);
      const auto matchFrom = [&](const TPose2D& start) {
        return matcher.match(likelihood, start, normalPrior(start, deviations));
      };
      TPose2D& pose = scans[i].pose;
      const ScanMatch match = matchFrom(pose);
      if (match.fit >= minFit) pose = match.pose;
      if (odometry.empty() || (i == 0 && !base)) return;
      const auto start = bestNear(likelihood, pose);
      if (!start) return;
      const ScanMatch other = matchFrom(*start);
      const double gain = likelihood.value(other.pose) - likelihood.value(pose);
      if (other.fit >= minFit && gain > kClearGain * static_cast<double>(beams.rays.size()))
        elsewhere[i] = other.pose;
    });
    if (!odometry.empty()) move(scans, elsewhere, odometry);
  }
}

void moveFirstTo(const TPose2D& pose, std::vector<PosedScans>& scans) {
  for (size_t i = scans.size(); i-- > 0;) scans[i].pose = pose + (scans[i].pose - scans.front().pose);
}

}  // namespace hybrid_slam
