#include "slam/loops/LaserAgreement.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>

#include "base/Degree.h"
#include "base/Median.h"
#include "base/PoseDistance.h"
#include "slam/grid/CorrelativeSearch.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kStep = 0.25, kStepAngle = 15 * kDegree;  // between two scans of a laser
constexpr double kWindow = 2.5;                            // m of path, before and after a scan
constexpr size_t kMostSeen = 100;  // before and after a scan: a robot may turn on the spot for hours
constexpr double kCell = 0.05;     // m
constexpr size_t kBeams = 90, kFewestBeams = 20;
constexpr double kMinFit = 0.25;                   // good matches fit 0.2 to 0.7
constexpr SearchWindow kSearch{0.3, 6 * kDegree};  // around where the poses of the lasers say
constexpr double kStdXY = 0.1, kStdPhi = 5 * kDegree;
constexpr size_t kFewestMatches = 20;
constexpr double kLargeTurn = 0.7 * kDegree;

}  // namespace

bool LaserOffset::isLarge() const { return std::abs(turn) > kLargeTurn; }

void LaserAgreement::add(const TPose2D& pose, const Scans& scans, double distance) {
  for (const auto& scan : scans) {
    const std::string& label = scan->sensorLabel;
    if (!reference_) reference_ = label;
    const auto [last, isFirst] = last_.try_emplace(label, pose);
    if (!isFirst && isWithin(last->second, pose, kStep, kStepAngle)) continue;
    last->second = pose;
    seen_.push_back({label, pose, distance, ScanBeams(toLaserScan(*scan, maxRange_))});
  }
  const auto isDue = [&] {
    return matched_ < seen_.size() &&
           (seen_[matched_].distance < distance - kWindow || seen_.size() - matched_ > kMostSeen);
  };
  for (; isDue(); ++matched_)
    if (seen_[matched_].laser != reference_) matchToReference(seen_[matched_]);
  const auto isOld = [&] {
    return matched_ > 0 &&
           (seen_.front().distance < seen_[matched_ - 1].distance - kWindow || matched_ > kMostSeen);
  };
  for (; isOld(); --matched_) seen_.pop_front();
}

void LaserAgreement::matchToReference(const Seen& seen) {
  const ScanBeams beams = seen.beams.thinned(kBeams);
  if (beams.rays.size() < kFewestBeams) return;
  GridOptions options;
  options.resolution = kCell;
  options = decisive(options);
  OccupancyGrid map(kCell);
  for (const Seen& other : seen_)
    if (other.laser == reference_ && std::abs(other.distance - seen.distance) <= kWindow)
      map.insert(other.beams, other.pose, options);
  const ScanMatcher matcher{ScanMatcherOptions()};
  const Prior prior = normalPrior(seen.pose, {kStdXY, kStdXY, kStdPhi});
  ScanMatch best = matcher.match(beams, seen.pose, map, prior);
  for (const TPose2D& place : correlativeSearch(beams, seen.pose, map, kSearch, 2)) {
    const ScanMatch match = matcher.match(beams, place, map, prior);
    if (match.logPosterior > best.logPosterior) best = match;
  }
  if (best.fit >= kMinFit) turns_[seen.laser].push_back((best.pose - seen.pose).phi);
}

std::vector<LaserOffset> LaserAgreement::offsets() const {
  std::vector<LaserOffset> all;
  for (const auto& [laser, turns] : turns_)
    if (turns.size() >= kFewestMatches) all.push_back({laser, *reference_, median(turns), turns.size()});
  return all;
}

}  // namespace hybrid_slam
