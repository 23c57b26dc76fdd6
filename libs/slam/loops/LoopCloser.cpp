#include "slam/loops/LoopCloser.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "base/Degree.h"
#include "base/PoseDistance.h"
#include "base/PoseRotation.h"
#include "slam/loops/PathCorrection.h"
#include "slam/loops/WallHeadings.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kKeyframeDistance = 0.95, kKeyframeAngle = 30 * kDegree;
constexpr size_t kKeptBeams = 181;  // kept of an update
constexpr double kReach = 6;        // m of path to either side of a place: its local map
constexpr double kLonger = 2.5;     // times the length, where several places fit
constexpr size_t kPlaces = 3;       // tried in an attempt
constexpr double kNearby = 3;       // m, between two places that show the same
constexpr double kSame = 0.2, kSameAngle = 1.5 * kDegree;  // m, rad: the path closes the loop itself
constexpr double kAgree = 0.4, kAgreeAngle = 3 * kDegree;  // m, rad: two matches agree
constexpr double kForget = 15;                             // m of path after which a match is forgotten
constexpr double kMinOverlap = 0.5, kHeldOverlap = 0.3;
constexpr double kAttempt = 1.5, kAfterHeld = 3;  // m of path between attempts
constexpr double kMaxAngle = 20 * kDegree;        // searched
constexpr double kMaxChi2 = 16;                   // of a correction, under the path's uncertainty

/// Standard deviations in x, y (m) and heading (rad) that a match has at most. A held pair may be unknown
/// along a corridor; of a match, every other pose in the window scores less.
const Eigen::Vector3d kOfHeld(10, 10, 1), kOfMatch(kSame, kSame, kSameAngle);
/// Of the robot found in an earlier map.
const Eigen::Vector3d kOfJoin(0.1, 0.1, 0.5 * kDegree);

SearchWindow searchWindow(const Eigen::Matrix3d& covariance, double maxOffset) {
  const double offset = 3 * std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  return {std::clamp(offset, std::min(0.6, maxOffset), maxOffset),
          std::clamp(3 * std::sqrt(covariance(2, 2)), 4 * kDegree, kMaxAngle)};
}

/// Inverse of the covariance of a match, between these deviations and 5 cm and 0.25 deg. The matcher's
/// information is tempered: its beams are not independent.
Eigen::Matrix3d edgeInformation(const Eigen::Matrix3d& information, const Eigen::Vector3d& deviations) {
  const Eigen::Matrix3d least =
      Eigen::Vector3d(0.05 * 0.05, 0.05 * 0.05, 0.25 * kDegree * kDegree).asDiagonal();
  const Eigen::Matrix3d regular =
      0.1 * information + deviations.cwiseAbs2().cwiseInverse().asDiagonal().toDenseMatrix();
  return (regular.inverse() + least).inverse();
}

}  // namespace

LoopCloser::LoopCloser(const LoopClosingOptions& options, const GridOptions& grid)
    : options_(options), grid_(grid) {
  grid_.resolution = std::max(0.1, grid.resolution);
}

void LoopCloser::add(const TPose2D& motion, const LaserScans& scans, const std::vector<LineSegment>& lines,
                     bool hasSlipped) {
  motion_ = motion_ + motion;
  const StepVariance step = stepVariance(motion, hasSlipped);
  variance_.position += step.position, variance_.heading += step.heading;
  toAttempt_ -= motion.norm();
  const size_t update = updates_++;
  if (!keyframes_.empty() && motion_.norm() < kKeyframeDistance && std::abs(motion_.phi) < kKeyframeAngle)
    return;
  ScanBeams beams = ScanBeams(scans).thinned(kKeptBeams);
  beams.rays.shrink_to_fit();
  keyframes_.push_back({update, std::move(beams)});
  variances_.push_back(variance_);
  wallDirections_.push_back(wallDirection(lines));
  motion_ = TPose2D(), variance_ = StepVariance();
}

LocalMap LoopCloser::newest(const Track& track, double length) const {
  const auto first =
      std::lower_bound(track.distances.begin(), track.distances.end(), track.distances.back() - length);
  return localMap(keyframes_, track.poses, static_cast<size_t>(first - track.distances.begin()),
                  keyframes_.size(), grid_);
}

LocalMap LoopCloser::around(const Track& track, size_t keyframe, double reach, double length) const {
  const auto& distances = track.distances;
  const double end =
      std::min(distances[keyframe] + reach, distances.back() - std::max(options_.minDistance, length));
  const auto from = std::lower_bound(distances.begin(), distances.end(), distances[keyframe] - reach);
  const auto to = std::upper_bound(from, distances.end(), end);
  return localMap(keyframes_, track.poses, static_cast<size_t>(from - distances.begin()),
                  static_cast<size_t>(to - distances.begin()), grid_);
}

std::vector<size_t> LoopCloser::places(const Track& track, size_t here,
                                       const PathUncertainty& uncertainty) const {
  struct Place {
    double distance;
    size_t keyframe;
  };
  std::vector<Place> all;
  for (size_t k = 0; k < track.poses.size(); ++k) {
    if (track.distances[k] > track.distances.back() - options_.stretch - options_.minDistance) break;
    const double distance = distanceBetween(track.poses[k], track.poses[here]);
    if (distance < kNearby + options_.maxOffset) all.push_back({distance, k});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Place& a, const Place& b) { return a.distance < b.distance; });
  std::vector<size_t> chosen;
  for (const Place& place : all) {
    const bool isNew = std::none_of(chosen.begin(), chosen.end(), [&](size_t k) {
      return std::abs(track.distances[k] - track.distances[place.keyframe]) < 2 * kReach;
    });
    if (!isNew) continue;
    const Eigen::Matrix3d covariance = uncertainty.between(place.keyframe, here, track.known);
    if (place.distance > kNearby + 3 * std::sqrt(covariance(0, 0) + covariance(1, 1))) continue;
    chosen.push_back(place.keyframe);
    if (chosen.size() == kPlaces) break;
  }
  return chosen;
}

LoopCloser::Outcome LoopCloser::tryEarlierMap(const Track& track, const LocalMap& stretch,
                                              const PathUncertainty& uncertainty, const OccupancyGrid& map) {
  const size_t here = stretch.reference;
  const auto covariance = uncertainty.inMap(here, track.known);
  if (!covariance) return Outcome::none;
  double extent = 0;
  for (const ScanBeams::Ray& ray : stretch.ends.rays) extent = std::max(extent, ray.range);
  const double reach = extent + searchWindow(*covariance, options_.maxOffset).distance;
  const TPose2D& pose = track.poses[here];
  return tryPlace(track, stretch, localMap(map, {pose.x, pose.y}, reach, grid_.resolution), *covariance);
}

LoopCloser::Outcome LoopCloser::tryPlace(const Track& track, const LocalMap& stretch, const LocalMap& older,
                                         const Eigen::Matrix3d& covariance) {
  const size_t here = stretch.reference;
  const TPose2D frame = track.frame(older.reference);
  const TPose2D expected = track.poses[here] - frame;
  const LoopMatch near = matchFrom(expected, stretch, older);
  const auto isWhereExpected = [&](const LoopMatch& match) {
    return isWithin(match.pose, expected, kSame, kSameAngle);
  };
  if (near.agreement.fit >= options_.minFit && isWhereExpected(near)) {
    if (near.agreement.overlap < kHeldOverlap) return Outcome::none;
    // The filter has closed this loop itself: hold the relative pose that it found.
    loops_.push_back({older.reference, here, expected,
                      edgeInformation(informationOf(near.pose, stretch, older), kOfHeld)});
    candidates_.clear();
    return Outcome::held;
  }
  const auto best = searchMatch(expected, searchWindow(covariance, options_.maxOffset), stretch, older);
  if (!best || best->agreement.fit < options_.minFit || best->agreement.overlap < kMinOverlap)
    return Outcome::none;
  if (best->second > options_.maxSecond) return Outcome::ambiguous;
  if (isWhereExpected(*best)) return Outcome::none;
  // The correction under the uncertainty, which holds for the axes of the map.
  const TPose2D corrected = frame + best->pose;
  const Eigen::Vector3d off(corrected.x - track.poses[here].x, corrected.y - track.poses[here].y,
                            mrpt::math::wrapToPi(corrected.phi - track.poses[here].phi));
  if (off.dot(covariance.inverse() * off) > kMaxChi2) return Outcome::none;
  remember(track, {{older.reference, here, best->pose,
                    edgeInformation(informationOf(best->pose, stretch, older), kOfMatch)},
                   best->agreement.fit,
                   best->second});
  return Outcome::found;
}

void LoopCloser::joinMap(const std::vector<TPose2D>& path) {
  if (keyframes_.empty()) return;
  const size_t last = keyframes_.size() - 1;
  const Eigen::Matrix3d covariance = kOfJoin.cwiseAbs2().asDiagonal();
  loops_.push_back({PoseEdge::kMapFrame, last, path.at(keyframes_[last].update), covariance.inverse()});
}

void LoopCloser::remember(const Track& track, const Candidate& candidate) {
  const size_t here = candidate.edge.to;
  const TPose2D corrected = track.frame(candidate.edge.from) + candidate.edge.relative;
  const bool agrees = std::all_of(candidates_.begin(), candidates_.end(), [&](const Candidate& before) {
    if (track.distances[here] - track.distances[before.edge.to] > kForget) return false;
    const TPose2D byBefore = track.frame(before.edge.from) + before.edge.relative +
                             (track.poses[here] - track.poses[before.edge.to]);
    return isWithin(byBefore, corrected, kAgree, kAgreeAngle);
  });
  if (!agrees) candidates_.clear();
  candidates_.push_back(candidate);
}

static_assert(PoseEdge::kMapFrame == KnownPair::kMapFrame);  // `trackOf` copies one to the other

LoopCloser::Track LoopCloser::trackOf(const std::vector<TPose2D>& path) const {
  Track track;
  for (const Keyframe& keyframe : keyframes_) {
    const TPose2D& pose = path.at(keyframe.update);
    track.distances.push_back(
        track.poses.empty() ? 0 : track.distances.back() + distanceBetween(track.poses.back(), pose));
    track.poses.push_back(pose);
  }
  for (const PoseEdge& edge : loops_)
    track.known.push_back(
        {edge.from, edge.to, rotated(edge.information.inverse(), track.frame(edge.from).phi)});
  return track;
}

std::optional<LoopClosure> LoopCloser::close(const std::vector<TPose2D>& path,
                                             const std::optional<double>& direction,
                                             const OccupancyGrid* earlier) {
  toAttempt_ = kAttempt;
  const Track track = trackOf(path);
  if (track.distances.back() < options_.stretch + options_.minDistance) return std::nullopt;
  const LocalMap stretch = newest(track, options_.stretch);
  const PathUncertainty uncertainty(track.poses, variances_);
  // Where several places fit, a longer stretch is tried.
  const auto attempt = [&](const auto& tried) {
    const Outcome outcome = tried(stretch, 1);
    return outcome == Outcome::ambiguous ? tried(newest(track, kLonger * options_.stretch), kLonger)
                                         : outcome;
  };
  const auto isOver = [](Outcome outcome) { return outcome == Outcome::held || outcome == Outcome::found; };
  auto outcome = Outcome::none;
  if (earlier)
    outcome = attempt(
        [&](const LocalMap& newer, double) { return tryEarlierMap(track, newer, uncertainty, *earlier); });
  if (!isOver(outcome))
    for (const size_t place : places(track, stretch.reference, uncertainty)) {
      outcome = attempt([&](const LocalMap& newer, double longer) {
        const LocalMap older = around(track, place, longer * kReach, longer * options_.stretch);
        return tryPlace(track, newer, older,
                        uncertainty.between(older.reference, newer.reference, track.known));
      });
      if (isOver(outcome)) break;
    }
  if (outcome == Outcome::held) {
    toAttempt_ = kAfterHeld;
    return std::nullopt;
  }
  if (candidates_.size() < static_cast<size_t>(options_.agreeing)) return std::nullopt;
  return optimise(path, track, direction);
}

std::vector<Revisit> LoopCloser::revisits(const std::vector<TPose2D>& poses) const {
  RevisitCheck check(RevisitCheck::kReturn);
  const std::vector<double> distances = lengthsAlong(poses);
  for (size_t i = 0; i < poses.size(); ++i) {
    ScanBeams beams{keyframes_[i].beams};
    const auto isFar = [this](const ScanBeams::Ray& ray) {
      return ray.range > RevisitCheck::rangeOf(grid_.maxRange);
    };
    beams.rays.erase(std::remove_if(beams.rays.begin(), beams.rays.end(), isFar), beams.rays.end());
    check.add(poses[i], beams, distances[i], i);
  }
  return check.revisits();
}

std::vector<PoseEdge> LoopCloser::motionEdges(const Track& track) const {
  std::vector<PoseEdge> edges;
  for (size_t i = 1; i < track.poses.size(); ++i) {
    const StepVariance& variance = variances_[i];
    const Eigen::Vector3d inverse(1 / variance.position, 1 / variance.position, 1 / variance.heading);
    edges.push_back({i - 1, i, track.poses[i] - track.poses[i - 1], inverse.asDiagonal()});
  }
  return edges;
}

std::optional<LoopClosure> LoopCloser::optimise(const std::vector<TPose2D>& path, const Track& track,
                                                const std::optional<double>& direction) {
  PoseGraph graph;
  graph.poses = track.poses;
  graph.motions = motionEdges(track);
  if (direction)
    for (const PoseEdge& edge : wallHeadings(track.poses, track.distances, wallDirections_, *direction))
      graph.motions.push_back(edge);
  graph.loops = loops_;
  for (const Candidate& candidate : candidates_) graph.loops.push_back(candidate.edge);
  const OptimizedGraph result = optimized(graph);

  // All of the new matches must hold, and at most one of the older pairs may be false. A false loop bends the
  // path, so that scans end in free space.
  const auto newMatches = result.isFalse.end() - static_cast<ptrdiff_t>(candidates_.size());
  const auto broken = std::count(result.isFalse.begin(), result.isFalse.end(), true);
  const bool holds = broken <= 1 && std::count(newMatches, result.isFalse.end(), true) == 0 &&
                     !isMoreContradicted(revisits(track.poses), revisits(result.poses));
  const std::vector<Candidate> candidates = std::move(candidates_);
  candidates_.clear();
  if (!holds) return std::nullopt;

  std::vector<size_t> nodes;
  for (const Keyframe& keyframe : keyframes_) nodes.push_back(keyframe.update);
  LoopClosure closure;
  closure.path = corrected(path, nodes, result.poses);
  for (size_t i = 0; i < path.size(); ++i) {
    closure.shift = std::max(closure.shift, distanceBetween(closure.path[i], path[i]));
    closure.turn = std::max(closure.turn, angleBetween(closure.path[i], path[i]));
  }
  for (size_t i = loops_.size(); i-- > 0;)
    if (result.isFalse[i]) loops_.erase(loops_.begin() + static_cast<ptrdiff_t>(i));
  const PoseEdge& last = candidates.back().edge;
  if (last.from != PoseEdge::kMapFrame) closure.earlier = keyframes_[last.from].update;
  closure.later = keyframes_[last.to].update;
  closure.place = closure.path[closure.later];
  closure.fit = 1;
  for (const Candidate& candidate : candidates) {
    closure.fit = std::min(closure.fit, candidate.fit);
    closure.second = std::max(closure.second, candidate.second);
    loops_.push_back(candidate.edge);
  }
  closure.matches = candidates.size();
  return closure;
}

}  // namespace hybrid_slam
