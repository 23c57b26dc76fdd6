#include "slam/localization/GlobalLocalization.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

#include "base/PoseDistance.h"
#include "slam/filter/Threads.h"
#include "slam/grid/CorrelativeSearch.h"
#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr size_t kPlaces = 200;        // found by a search
constexpr size_t kHypotheses = 200;    // followed
constexpr size_t kNear = 8;            // starting points of the local optimisation around a given pose
constexpr double kIndependent = 0.25;  // scans half a metre apart that count as much as independent ones
constexpr double kUnexplained = -1.2;  // ln w_grid of a scan of a place that is not in the map
constexpr double kElsewhere = 0.1;     // least belief that no hypothesis is right, until one is declared
constexpr size_t kAnywhere = 100;      // places that represent it, at most
constexpr double kHopeless = 40;       // ln of the ratio of weights to the best, to be dropped
constexpr size_t kFirst = 4;           // scans that must support a new hypothesis,
constexpr double kSupport = 2;  // with this ln of the ratio of weights to a place that is not in the map
constexpr double kSame = 0.5, kSameAngle = mrpt::DEG2RAD(10.0);  // m, of two hypotheses of one place
constexpr double kStdXY = 0.15, kStdPhi = mrpt::DEG2RAD(3.0);    // of a pose before a match

// A place is declared if
constexpr size_t kScans = 5;       // number of remembered scans reaches this,
constexpr long kRecent = 8;        // it explains three quarters of these newest,
constexpr long kNewest = 3;        // all of these,
constexpr double kMargin = 10;     // other places are less likely by this ln of the ratio,
constexpr double kSearched = 0.1;  // and all with a score within this of the best were looked at.
constexpr double kExplained = 0.7, kContradicted = 0.15;  // share of the beams of an explained scan

/// Considers the newest scans: earlier ones would hide that the robot was carried elsewhere, and scans
/// outside the map would hide its return.
bool explains(const Hypothesis& hypothesis) {
  const auto& evidence = hypothesis.evidence;
  if (evidence.size() < kScans) return false;
  const auto isMissed = [](const ScanEvidence& scan) { return !isExplained(scan.shares); };
  const auto recent = std::min<long>(kRecent, static_cast<long>(evidence.size()));
  return 4 * std::count_if(evidence.end() - recent, evidence.end(), isMissed) <= recent &&
         std::none_of(evidence.end() - kNewest, evidence.end(), isMissed);
}

bool isSamePlace(const TPose2D& a, const TPose2D& b) { return isWithin(a, b, kSame, kSameAngle); }

}  // namespace

bool isExplained(const BeamShares& scan) {
  return scan.explained > kExplained && scan.contradicted < kContradicted;
}

GlobalLocalization::GlobalLocalization(const GridWeightOptions& gridWeight, const ScanMatcherOptions& matcher,
                                       OccupancyGrid grid, LineDatabase lines)
    : grid_(std::move(grid)),
      lines_(std::move(lines)),
      exponent_(gridWeight.exponent * kIndependent),
      matcher_(matcher),
      gridWeight_(gridWeight, grid_.resolution()),
      search_(grid_, grid_.middle()) {
  std::vector<TPoint2D> places;
  for (double spacing = 2; spacing == 2 || places.size() > kAnywhere; spacing *= 1.5)
    places = search_.freePlaces(spacing);
  for (const TPoint2D& at : places)
    for (const double heading : {0.0, M_PI / 2, M_PI, -M_PI / 2})
      anywhere_.push_back({{at.x, at.y, heading}, 0});
}

/// Corrects the pose and weighs the scan there.
ScanEvidence GlobalLocalization::match(const PreparedScan& scan, TPose2D& pose) const {
  const Prior prior = normalPrior(pose, {kStdXY, kStdXY, kStdPhi});
  pose = matcher_.match(scan.matchedBeams, pose, grid_, prior).pose;
  return {gridWeight_.logWeight(scan.weighedBeams, scan.scans, pose, grid_),
          beamShares(scan.matchedBeams, pose, grid_)};
}

void GlobalLocalization::follow(Hypothesis& hypothesis, const RecentScans& recent) const {
  const size_t newest = recent.scans().size() - 1;
  hypothesis.pose = hypothesis.pose + recent.motion(newest - 1, newest);
  hypothesis.evidence.push_back(match(recent.scans()[newest].scan, hypothesis.pose));
  while (hypothesis.evidence.size() > recent.scans().size())
    hypothesis.evidence.erase(hypothesis.evidence.begin());
  weigh(hypothesis);
}

// Takes the scans from the newest backwards, so that a poor hypothesis is given up early.
Hypothesis GlobalLocalization::judged(const TPose2D& pose, const RecentScans& recent) const {
  Hypothesis hypothesis;
  TPose2D at = pose;
  for (size_t i = recent.scans().size(); i-- > 0;) {
    hypothesis.evidence.push_back(match(recent.scans()[i].scan, at));
    if (hypothesis.evidence.size() == 1) hypothesis.pose = at;
    weigh(hypothesis);
    if (hypothesis.evidence.size() == kFirst && hypothesis.logWeight < unexplained(kFirst) + kSupport) {
      hypothesis.logWeight = -INFINITY;
      return hypothesis;
    }
    if (i > 0) at = at + recent.motion(i, i - 1);
  }
  std::reverse(hypothesis.evidence.begin(), hypothesis.evidence.end());
  return hypothesis;
}

double GlobalLocalization::unexplained(size_t scans) const {
  return exponent_ * kUnexplained * static_cast<double>(scans);
}

// A scan of something that is not in the map neither supports nor contradicts a place.
void GlobalLocalization::weigh(Hypothesis& hypothesis) const {
  hypothesis.logWeight = 0;
  for (const ScanEvidence& scan : hypothesis.evidence)
    hypothesis.logWeight += exponent_ * std::max(scan.logGrid, kUnexplained);
}

void GlobalLocalization::update(const RecentScans& recent, tbb::task_arena& arena) {
  parallelFor(arena, 0, hypotheses_.size(), [&](size_t i) { follow(hypotheses_[i], recent); });
  const ScanBeams joined = recent.joined();
  const auto places = search_(joined, alignedHeadings(recent.lines(), lines_), kPlaces);
  std::vector<Hypothesis> found(places.size());
  parallelFor(arena, 0, places.size(), [&](size_t i) {
    const ScanMatch match = matcher_.match(joined, places[i].pose, grid_, noPrior);
    found[i] = judged(match.pose, recent);
  });
  hypotheses_.insert(hypotheses_.end(), found.begin(), found.end());
  std::stable_sort(hypotheses_.begin(), hypotheses_.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.logWeight > b.logWeight; });
  std::vector<Hypothesis> kept;
  for (Hypothesis& hypothesis : hypotheses_) {
    const double least = std::max(hypotheses_[0].logWeight, unexplained(recent.scans().size())) - kHopeless;
    if (kept.size() == kHypotheses || hypothesis.logWeight < least) break;
    const bool isKnown = std::any_of(kept.begin(), kept.end(), [&hypothesis](const Hypothesis& other) {
      return isSamePlace(hypothesis.pose, other.pose);
    });
    if (!isKnown) kept.push_back(std::move(hypothesis));
  }
  hypotheses_ = std::move(kept);
  const bool isCut = places.size() == kPlaces && places.back().score > places.front().score - kSearched;
  isFound_ = !isCut && decide();
}

bool GlobalLocalization::decide() const {
  if (hypotheses_.empty()) return false;
  const Hypothesis& best = hypotheses_[0];
  if (best.logWeight < unexplained(best.evidence.size()) + kMargin) return false;
  if (hypotheses_.size() > 1 && hypotheses_[1].logWeight > best.logWeight - kMargin) return false;
  return explains(best);
}

bool GlobalLocalization::refutes(const TPose2D& pose, const RecentScans& recent) const {
  return !hypotheses_.empty() && !isSamePlace(hypotheses_[0].pose, pose) && explains(hypotheses_[0]) &&
         hypotheses_[0].logWeight > judged(pose, recent).logWeight + kMargin;
}

std::vector<WeightedPose> GlobalLocalization::poses(const TPose2D& since) const {
  std::vector<WeightedPose> all;
  if (!hypotheses_.empty()) {
    const double best = hypotheses_[0].logWeight;
    double sum = 0;
    for (const Hypothesis& hypothesis : hypotheses_) {
      all.push_back({hypothesis.pose + since, hypothesis.logWeight - best});
      sum += std::exp(all.back().logWeight);
    }
    const double elsewhere = std::max(unexplained(hypotheses_[0].evidence.size()) - best,
                                      std::log(sum * kElsewhere / (1 - kElsewhere)));
    for (const WeightedPose& place : anywhere_)
      all.push_back({place.pose, elsewhere - std::log(static_cast<double>(anywhere_.size()))});
  } else {
    all = anywhere_;
  }
  return all;
}

Hypothesis GlobalLocalization::near(const TPose2D& pose, const SearchWindow& window,
                                    const RecentScans& recent) const {
  Hypothesis best = judged(pose, recent);
  for (const TPose2D& place :
       correlativeSearch(recent.scans().back().scan.matchedBeams, pose, grid_, window, kNear))
    if (Hypothesis other = judged(place, recent); other.logWeight > best.logWeight) best = std::move(other);
  return best;
}

}  // namespace hybrid_slam
