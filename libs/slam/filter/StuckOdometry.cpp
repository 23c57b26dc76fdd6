#include "slam/filter/StuckOdometry.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "slam/grid/GlobalSearch.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kStill = 1e-6;     // m and rad; encoders that stand repeat their values
constexpr double kLeastTime = 0.5;  // s
constexpr double kLeastMove = 0.15, kLeastTurn = mrpt::DEG2RAD(4.0);  // of a robot that drives, by its scans
constexpr double kSameMove = 0.05, kSameTurn = mrpt::DEG2RAD(2.0),
                 kSameShare = 0.3;  // of two motions that agree
constexpr double kLeastGain = 0.1;  // of the share of explained beams
constexpr size_t kDistrusted = 20;  // after as many changes the odometry is used again in any case

bool stands(const TPose2D& odometry) {
  return odometry.norm() < kStill && std::abs(mrpt::math::wrapToPi(odometry.phi)) < kStill;
}

bool agree(const TPose2D& odometry, const TPose2D& scans) {
  return (odometry - scans).norm() < kSameMove + kSameShare * scans.norm() &&
         std::abs(mrpt::math::wrapToPi(odometry.phi - scans.phi)) <
             kSameTurn + kSameShare * std::abs(scans.phi);
}

}  // namespace

StuckOdometry::StuckOdometry(const GridOptions& grid, const ScanMatcherOptions& matcher)
    : grid_(grid), matcher_(matcher) {}

TPose2D StuckOdometry::motionTo(const TPose2D& odometry, const Scans& scans, double timestamp) {
  if (!isStuck_ && !stands(odometry)) {
    keep(odometry, scans, timestamp);
    return odometry;
  }
  const TPose2D motion = matched(scans, timestamp);
  if (isStuck_) {
    if (!stands(odometry)) ++distrusted_;
    isStuck_ = stands(odometry) || (!agree(odometry, motion) && distrusted_ < kDistrusted);
    if (!isStuck_) keep(odometry, scans, timestamp);
    return motion;
  }
  moved_ = moved_ + motion;
  const bool drives = moved_.norm() > kLeastMove || std::abs(moved_.phi) > kLeastTurn;
  if (!drives || timestamp - stoodSince_ < kLeastTime || !isStandingRefuted(scans, moved_)) return odometry;
  isStuck_ = true;
  distrusted_ = 0;
  return moved_;
}

void StuckOdometry::keep(const TPose2D& motion, const Scans& scans, double timestamp) {
  scanOdometry_.reset();
  lastMotion_ = motion;
  lastDuration_ = lastScans_.empty() ? 0 : timestamp - lastTime_;
  lastScans_ = scans, lastTime_ = timestamp;
}

/// Matches the scans to those since the odometry stood still.
TPose2D StuckOdometry::matched(const Scans& scans, double timestamp) {
  if (!scanOdometry_) {
    if (lastScans_.empty()) keep({}, scans, timestamp);
    scanOdometry_.emplace(grid_, matcher_);
    scanOdometry_->motionTo(lastScans_, lastTime_);
    // With a scan per metre, the robot that drives on is out of reach of a search around where it was.
    if (isStandingRefuted(scans, lastMotion_)) scanOdometry_->setLastMotion(lastMotion_, lastDuration_);
    stoodSince_ = lastTime_;
    moved_ = TPose2D();
  }
  return scanOdometry_->motionTo(scans, timestamp);
}

// People who walk past a robot that stands hide the walls, but do not explain more of them elsewhere.
bool StuckOdometry::isStandingRefuted(const Scans& scans, const TPose2D& moved) const {
  GridOptions options = hitsAlone(grid_);  // one scan shows walls and free space
  options.pHit = 0.9, options.pMiss = 0.2;
  OccupancyGrid last(grid_.resolution);
  last.insert(ScanBeams(toLaserScans(lastScans_, grid_.maxRange)), TPose2D(), options);
  const ScanBeams beams(toLaserScans(scans, grid_.maxRange));
  return beamShares(beams, moved, last).explained > beamShares(beams, TPose2D(), last).explained + kLeastGain;
}

}  // namespace hybrid_slam
