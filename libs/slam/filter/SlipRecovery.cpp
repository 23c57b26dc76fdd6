#include "slam/filter/SlipRecovery.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

#include "slam/grid/CorrelativeSearch.h"
#include "slam/grid/GlobalSearch.h"
#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kPoorFit = 0.8;         // of the usual fit: search below this
constexpr double kForgetting = 0.1;      // weight of the newest scan in the usual fit
constexpr size_t kSlipPlaces = 8;        // starting points of the local optimisation
constexpr double kContradicted = 0.35;   // share of the beams: the robot is not there
constexpr double kUncontradicted = 0.2;  // share of the beams: it may be
constexpr double kRefuted = 0.1;         // share of the beams known to recent scans: they contradict the pose
constexpr double kMostlyRefuted = 0.5;   // share of the beams known to recent scans: the odometry is wrong
constexpr double kKnown = 0.2;           // share of the beams: fewer are no evidence
constexpr double kExplained = 0.5;       // share of the beams that recent scans explain: it was not carried
constexpr size_t kCarriedScans = 4;      // in succession, before the whole map is searched
constexpr size_t kMapPlaces = 40;
constexpr SearchWindow kPlace{0.2, mrpt::DEG2RAD(2.0)};  // how far a place of the map's search is off
constexpr double kRival = 3;  // ln of the ratio of posteriors between which a scan cannot decide
constexpr size_t kHypotheses = 6;
constexpr double kWholeStep = -9.2;  // ln 1e-4: prior of no motion or the opposite one, relative to a slip

/// Share of the beams known to a map that it contradicts; 1 if it knows too few to tell.
double refutedShare(const BeamShares& shares) {
  const double known = shares.explained + shares.contradicted;
  return known > kKnown ? shares.contradicted / known : 1;
}

}  // namespace

SlipRecovery::SlipRecovery(const FilterConfiguration& c)
    : options_(c.improved),
      motion_(c.motion),
      exponent_(c.gridWeight.exponent),
      prepare_(c),
      matcher_(c.matcher),
      gridWeight_(c.gridWeight, c.grid.resolution),
      recent_(c.grid) {}

// Compare by w_grid, which allows beams to end in unknown cells. The matcher's likelihood prefers any wall,
// and would pull the robot back along a partly seen corridor. A scan has no more independent beams than
// beams.
double SlipRecovery::logWeight(const TPose2D& pose, const Particle& best, const PreparedScan& scan) const {
  const double beams = std::min(exponent_, static_cast<double>(scan.weighedBeams.rays.size()));
  return beams * gridWeight_.logWeight(scan.weighedBeams, scan.scans, pose, best.grid);
}

std::vector<StepMotion> SlipRecovery::motionsOf(const Particle& best, const TPose2D& odometry,
                                                const PreparedScan& whole) {
  const TPose2D before = best.path.back();
  if (options_.slipDistance <= 0) return {{odometry, odometry, false}};
  const MotionDistribution expected = motionAfter(best, {odometry, odometry, false}, motion_, options_);
  const PreparedScan scan = prepare_.withoutMovedThings(whole, before + odometry, best.grid);
  const Eigen::Matrix3d information = expected.covariance.inverse();
  const auto asExpected = [&](const TPose2D& pose) {
    return gaussianLogDensity(pose, expected.mean, information);
  };
  Hypothesis usual{matcher_.match(scan.matchedBeams, expected.mean, best.grid, asExpected), 0, false};
  std::vector<Hypothesis> hypotheses{usual};
  if (usual.match.fit < kPoorFit * usualFit_) {
    usual.logPosterior = logWeight(usual.match.pose, best, scan) + asExpected(usual.match.pose).value;
    hypotheses = search(odometry, best, expected, usual, scan, whole);
  } else {
    contradicting_.clear();
  }
  std::vector<StepMotion> motions;
  for (const Hypothesis& hypothesis : hypotheses) {
    StepMotion motion{odometry, odometry, hypothesis.hasSlipped};
    if (motion.hasSlipped || hypothesis.match.fit >= options_.minFit)
      motion.start = hypothesis.match.pose - before;
    motions.push_back(motion);
  }
  if (hypotheses[0].isElsewhere) {
    contradicting_.clear();
    recent_.clear();
  }
  recent_.add(scan.matchedBeams);
  const double fit = hypotheses[0].match.fit;
  if (contradicting_.empty() && !scan.matchedBeams.rays.empty())
    usualFit_ = usualFit_ == 0 ? fit : (1 - kForgetting) * usualFit_ + kForgetting * fit;
  return motions;
}

/// Returns the hypotheses that rival the best one, best first; nearly equal poses count once.
template <class Hypothesis>
std::vector<Hypothesis> rivals(std::vector<Hypothesis> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.logPosterior > b.logPosterior; });
  std::vector<Hypothesis> kept;
  for (const Hypothesis& hypothesis : all) {
    if (kept.size() == kHypotheses || all[0].logPosterior - hypothesis.logPosterior > kRival) break;
    const TPose2D& pose = hypothesis.match.pose;
    const bool isKnown = std::any_of(kept.begin(), kept.end(), [&pose](const Hypothesis& other) {
      const TPose2D offset = pose - other.match.pose;
      return offset.norm() < 0.2 && std::abs(offset.phi) < mrpt::DEG2RAD(5.0);
    });
    if (!isKnown) kept.push_back(hypothesis);
  }
  return kept;
}

std::vector<SlipRecovery::Hypothesis> SlipRecovery::search(const TPose2D& odometry, const Particle& best,
                                                           const MotionDistribution& expected,
                                                           const Hypothesis& usual, const PreparedScan& scan,
                                                           const PreparedScan& whole) {
  const OccupancyGrid recent = recent_.map(best.path, contradicting_.size());
  const auto refuted = [&](const TPose2D& pose) {
    return refutedShare(beamShares(scan.matchedBeams, pose, recent));
  };
  // A match to a map that is off may contradict the recent scans where the odometry agrees with them.
  const double asExpected = std::min(refuted(usual.match.pose), refuted(expected.mean));
  const auto unrefuted = [&](std::vector<Hypothesis> all) {
    const double most = std::max(kRefuted, asExpected);
    const auto isRefuted = [&](const Hypothesis& h) { return refuted(h.match.pose) > most; };
    all.erase(std::remove_if(all.begin(), all.end(), isRefuted), all.end());
    return all.empty() ? std::vector<Hypothesis>{usual} : all;
  };
  std::vector<Hypothesis> found = unrefuted(searchNearby(odometry, best, expected, usual, scan));
  const auto isContradicted = [&] {
    const TPose2D& pose = found[0].match.pose;
    if (beamShares(scan.matchedBeams, pose, best.grid).contradicted <= kContradicted) return false;
    if (std::min(asExpected, refuted(pose)) >= kRefuted) return true;
    // A robot that was carried drives on, to where the scans before it show little.
    return !contradicting_.empty() && beamShares(scan.matchedBeams, pose, recent).explained < kExplained;
  };
  if (isContradicted()) {
    std::vector<Hypothesis> turned =
        unrefuted(searchWindow(expected.mean, {options_.slipDistance, M_PI}, best, expected, usual, scan));
    // A scan fits where the robot is; where a map is off, it may fit better elsewhere, but badly. A robot
    // that was carried is nowhere near, and the scans before it show that.
    const BeamShares shares = beamShares(scan.matchedBeams, turned[0].match.pose, best.grid);
    if (asExpected > kMostlyRefuted || refutedShare(shares) <= kUncontradicted) found = std::move(turned);
  }
  if (!isContradicted()) {
    contradicting_.clear();
    return found;
  }
  contradicting_.push_back({odometry, whole.matchedBeams});
  // The map of recent scans leaves out as many, or all.
  if (contradicting_.size() > RecentMap::kScans) contradicting_.pop_front();
  const auto elsewhere = searchMap(best, whole);
  return elsewhere.empty() ? found : elsewhere;
}

// Around the odometry; if the scan does not fit there, around a robot that stood still (spinning wheels) and
// one that moved backward (the odometry of some robots lacks the sign).
std::vector<SlipRecovery::Hypothesis> SlipRecovery::searchNearby(const TPose2D& odometry,
                                                                 const Particle& best,
                                                                 const MotionDistribution& expected,
                                                                 const Hypothesis& usual,
                                                                 const PreparedScan& scan) const {
  const SearchWindow window{options_.slipDistance, options_.slipAngle};
  std::vector<Hypothesis> found = searchWindow(expected.mean, window, best, expected, usual, scan);
  const bool isCovered = odometry.norm() <= options_.slipDistance / 2;  // backward is 2 steps away
  if (isCovered || found[0].match.fit >= kPoorFit * usualFit_) return found;
  for (const double share : {0, -1}) {
    const TPose2D motion(share * odometry.x, share * odometry.y, odometry.phi);
    auto more = searchWindow(best.path.back() + motion, window, best, expected, usual, scan);
    for (Hypothesis& hypothesis : more) hypothesis.logPosterior += kWholeStep;
    found.insert(found.end(), more.begin(), more.end());
  }
  return rivals(std::move(found));
}

std::vector<SlipRecovery::Hypothesis> SlipRecovery::searchWindow(
    const TPose2D& centre, const SearchWindow& window, const Particle& best,
    const MotionDistribution& expected, const Hypothesis& usual, const PreparedScan& scan) const {
  const Eigen::Matrix3d information = expected.covariance.inverse();
  // ln of the density of a slip over that of the motion model at its mean.
  const double slip =
      std::log(options_.slipProbability / (8 * window.distance * window.distance * window.angle)) +
      0.5 * std::log(expected.covariance.determinant() * std::pow(2 * M_PI, 3));
  std::vector<Hypothesis> all{usual};
  for (const TPose2D& place : correlativeSearch(scan.matchedBeams, centre, best.grid, window, kSlipPlaces)) {
    const ScanMatch match = matcher_.match(scan.matchedBeams, place, best.grid, noPrior);
    if ((match.pose - centre).norm() > 2 * window.distance) continue;  // slid along a wall
    const double modelled = gaussianLogDensity(match.pose, expected.mean, information).value;
    all.push_back({match, logWeight(match.pose, best, scan) + std::max(modelled, slip), slip > modelled});
  }
  return rivals(std::move(all));
}

std::vector<SlipRecovery::Hypothesis> SlipRecovery::searchMap(const Particle& best,
                                                              const PreparedScan& scan) const {
  std::vector<Hypothesis> all;
  if (!searchesMap_ || contradicting_.size() < kCarriedScans) return all;
  const GlobalSearch search(best.grid, mrpt::math::TPoint2D(best.path.back()));
  const auto searchAt = [&](const std::vector<double>& headings) {
    for (const auto& place : search(scan.matchedBeams, headings, kMapPlaces))
      for (const TPose2D& start : correlativeSearch(scan.matchedBeams, place.pose, best.grid, kPlace, 1)) {
        const ScanMatch match = matcher_.match(scan.matchedBeams, start, best.grid, noPrior);
        if (fitsAll(match.pose, best)) all.push_back({match, logWeight(match.pose, best, scan), true, true});
      }
  };
  const std::vector<double> aligned = alignedHeadings(scan.lines, *best.lines);
  searchAt(aligned);
  // The walls around the robot may not run along the dominating direction of the map.
  if (all.empty() && !aligned.empty()) searchAt({});
  return rivals(std::move(all));
}

bool SlipRecovery::fitsAll(TPose2D pose, const Particle& best) const {
  for (auto scan = contradicting_.rbegin(); scan != contradicting_.rbegin() + kCarriedScans; ++scan) {
    const ScanMatch match = matcher_.match(scan->beams, pose, best.grid, noPrior);
    const TPose2D offset = match.pose - pose;
    if (match.fit < kPoorFit * usualFit_ || offset.norm() > 0.3 ||
        std::abs(offset.phi) > mrpt::DEG2RAD(10.0) ||
        beamShares(scan->beams, match.pose, best.grid).contradicted > kUncontradicted)
      return false;
    pose = match.pose + (TPose2D() - scan->odometry);
  }
  return true;
}

MotionDistribution motionAfter(const Particle& before, const StepMotion& motion,
                               const MotionModelOptions& model, const ImprovedProposalOptions& options) {
  MotionDistribution distribution =
      motionDistribution(before.path.back(), motion.odometry, before.motion.model(model));
  distribution.covariance.diagonal().array() +=
      1e-8;  // (0.1 mm, 0.1 mrad)^2: without noise it has no inverse
  if (motion.hasSlipped) {
    const double distance = options.slipDistance, angle = options.slipAngle;
    distribution.mean = before.path.back() + motion.start;
    distribution.covariance.diagonal() +=
        Eigen::Vector3d(distance * distance, distance * distance, angle * angle);
  }
  return distribution;
}

}  // namespace hybrid_slam
