#include "slam/filter/ScanOdometry.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "slam/grid/BeamSelection.h"
#include "slam/grid/CorrelativeSearch.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kStdXY = 0.1, kStdPhi = mrpt::DEG2RAD(10.0);  // of the prediction
constexpr double kFarTurn = mrpt::DEG2RAD(10.0);               // from the prediction
constexpr SearchWindow kWindow{0.4, mrpt::DEG2RAD(30.0)};
constexpr size_t kPlaces = 4;    // starting points of the local optimisation
constexpr double kMinFit = 0.1;  // good matches fit 0.2 to 0.7
constexpr size_t kKeyframes = 20;
constexpr double kSlowing = 0.5;  // of a robot that sees nothing, per scan
constexpr double kKeyDistance = 0.1, kKeyAngle = mrpt::DEG2RAD(5.0);

}  // namespace

ScanOdometry::ScanOdometry(const GridOptions& grid, const ScanMatcherOptions& matcher)
    : grid_(decisive(grid)), matchedBeams_(matcher.beams), matcher_(matcher), map_(grid.resolution) {}

TPose2D ScanOdometry::motionTo(const Scans& observed, double timestamp, std::optional<double> turn) {
  const LaserScans scans = toLaserScans(observed, grid_.maxRange);
  const TPose2D before = pose_;
  const double duration = timestamp - lastTime_;
  TPose2D expected = predicted(duration);
  // Near the prediction the search finds the turn by itself, and better than odometry with wrong times.
  if (turn && std::abs(mrpt::math::wrapToPi(*turn - expected.phi)) > kFarTurn) expected.phi = *turn;
  pose_ = before + expected;
  const ScanBeams beams(scans, BeamSelection(scans).take(matchedBeams_));
  if (beams.rays.empty()) {  // without returns: keep the map, and slow down
    lastMotion_ = {kSlowing * expected.x, kSlowing * expected.y, kSlowing * expected.phi};
    lastDuration_ = duration, lastTime_ = timestamp;
    return expected;
  }
  const ScanMatch found = match(beams, pose_);
  const bool fits = found.fit >= kMinFit;
  if (fits)
    pose_ = found.pose;
  else
    keyframes_.clear();
  const TPose2D moved = keyframes_.empty() ? TPose2D() : pose_ - keyframes_.back().pose;
  if (keyframes_.empty() || moved.norm() > kKeyDistance || std::abs(moved.phi) > kKeyAngle)
    addKeyframe(ScanBeams(scans));
  const TPose2D motion = pose_ - before;
  lastMotion_ = fits ? motion : TPose2D();
  lastDuration_ = duration;
  lastTime_ = timestamp;
  return motion;
}

TPose2D ScanOdometry::predicted(double duration) const {
  // A robot may stop during a gap in the log: predict at most the last motion.
  const double scale = duration > 0 && lastDuration_ > 0 ? std::min(duration / lastDuration_, 1.0) : 1;
  return {scale * lastMotion_.x, scale * lastMotion_.y, scale * lastMotion_.phi};
}

ScanMatch ScanOdometry::match(const ScanBeams& beams, const TPose2D& expected) const {
  const Prior prior = normalPrior(expected, {kStdXY, kStdXY, kStdPhi});
  ScanMatch best = matcher_.match(beams, expected, map_, prior);
  for (const TPose2D& place : correlativeSearch(beams, expected, map_, kWindow, kPlaces)) {
    const ScanMatch match = matcher_.match(beams, place, map_, prior);
    if (match.logPosterior > best.logPosterior) best = match;
  }
  return best;
}

void ScanOdometry::addKeyframe(const ScanBeams& beams) {
  keyframes_.push_back({beams, pose_});
  if (keyframes_.size() > kKeyframes) keyframes_.pop_front();
  makeMap();
}

void ScanOdometry::makeMap() {
  map_ = OccupancyGrid(grid_.resolution);
  for (const Keyframe& keyframe : keyframes_) map_.insert(keyframe.beams, keyframe.pose, grid_);
}

}  // namespace hybrid_slam
