#include "run/VerdictCheck.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/PoseDistance.h"
#include "slam/merging/MapTransform.h"

namespace hybrid_slam::run {

using mrpt::math::TPose2D;

namespace {

constexpr double kStep = 0.5, kStepAngle = M_PI / 6;  // between compared scans

}  // namespace

bool ComparisonSteps::isDue(const TPose2D& pose) {
  if (last_ && isWithin(*last_, pose, kStep, kStepAngle)) return false;
  last_ = pose;
  return true;
}

OccupancyGrid toCompare(const OccupancyGrid& map) {
  constexpr double kCell = RevisitCheck::kResolution;
  return map.resolution() <= kCell ? resampled(map, {}, kCell) : OccupancyGrid(kCell);
}

void ScanComparisons::add(const TPose2D& pose, const ScanBeams& beams, double distance, size_t update) {
  returning_.add(pose, beams, distance, update);
  recent_.add(pose, beams, distance, update);
  if (earlier_) earlier_->add(pose, beams, distance, update);
}

Evidence ScanComparisons::evidence() const {
  Evidence evidence;
  evidence.returning = returning_.revisits();
  evidence.recent = recent_.revisits();
  evidence.beams = recent_.meanBeams();
  if (earlier_) evidence.earlier = earlier_->revisits();
  return evidence;
}

void VerdictCheck::addWay(double way, bool hasScans) {
  way_ += way;
  if (way_ > gap_.length)
    gap_ = {way_, last_ ? mrpt::math::TPoint2D(last_->x, last_->y) : mrpt::math::TPoint2D()};
  if (hasScans) way_ = 0;
}

void VerdictCheck::add(const TPose2D& pose, const Scans& scans) {
  const size_t update = updates_++;
  if (last_) distance_ += distanceBetween(*last_, pose);
  last_ = pose;
  lasers_.add(pose, scans, distance_);
  if (!steps_.isDue(pose)) return;
  comparisons_.add(pose, beamsToCompare(scans, maxRange_), distance_, update);
}

Evidence VerdictCheck::evidence() const {
  Evidence evidence = comparisons_.evidence();
  evidence.lasers = lasers_.offsets();
  evidence.gap = gap_;
  return evidence;
}

void ComparedScans::add(const TPose2D& pose, size_t update, const Scans& scans) {
  if (!steps_.isDue(pose)) return;
  const ScanBeams beams = beamsToCompare(scans, maxRange_);
  Scan scan{update, beams.origins, {}};
  for (const ScanBeams::Ray& ray : beams.rays)
    scan.beams.push_back({static_cast<float>(std::atan2(ray.dirY, ray.dirX)), static_cast<float>(ray.range),
                          static_cast<uint32_t>(ray.laser)});
  scans_.push_back(std::make_shared<const Scan>(std::move(scan)));
}

Evidence ComparedScans::evidence(const std::vector<TPose2D>& path, const OccupancyGrid* earlier) const {
  ScanComparisons comparisons;
  if (earlier) comparisons.compareWith(*earlier);
  double distance = 0;
  size_t reached = 0;
  for (const auto& scan : scans_) {
    for (; reached < scan->update; ++reached) distance += distanceBetween(path[reached], path[reached + 1]);
    ScanBeams beams;
    beams.origins = scan->origins;
    for (const Beam& beam : scan->beams)
      beams.rays.push_back({std::cos(beam.direction), std::sin(beam.direction), beam.range, beam.laser});
    comparisons.add(path[scan->update], beams, distance, scan->update);
  }
  return comparisons.evidence();
}

void RunningVerdict::add(const FilterView& view, const Scans& scans) {
  const auto particles = view.particlePoses();
  const auto best = std::max_element(particles.begin(), particles.end(),
                                     [](const auto& a, const auto& b) { return a.logWeight < b.logWeight; });
  scans_.add(best->pose, view.updates() - 1, scans);
  slips_ += view.lastStep().slipped.value_or(false);
  if (const OccupancyGrid* map = view.earlierMap(); map && !earlier_)
    earlier_ = std::make_shared<const OccupancyGrid>(toCompare(*map));
}

std::function<Verdict()> RunningVerdict::judge(const FilterView& view) const {
  const double spread = std::hypot(view.lastStep().stdX, view.lastStep().stdY);
  return [scans = scans_, earlier = earlier_, path = view.bestPath(), spread, slips = slips_,
          updates = view.updates()] {
    Evidence evidence = scans.evidence(path, earlier.get());
    evidence.spread = spread;
    evidence.slips = slips;
    evidence.updates = updates;
    return verdictOf(evidence);
  };
}

}  // namespace hybrid_slam::run
