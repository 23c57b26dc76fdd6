#include "slam/filter/MountingEstimate.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/Degree.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kBetween = 0.1, kTurnBetween = 5 * kDegree;  // odometry between two scans matched
constexpr double kStep = 0.3, kTurnStep = 10 * kDegree;
constexpr double kStraight = 5 * kDegree;  // turned at most in a straight step
constexpr size_t kMostMatched = 500;
constexpr size_t kFewestStraight = 20, kFewestTurns = 5;
constexpr double kAgreeing = 0.9, kWithin = 10 * kDegree;

/// Returns the direction of a step (rad), in the frame halfway.
double directionOf(const TPose2D& step) { return std::atan2(step.y, step.x) - step.phi / 2; }

}  // namespace

MountingEstimate::MountingEstimate(const GridOptions& grid, const ScanMatcherOptions& matcher)
    : scanOdometry_(grid, matcher) {}

void MountingEstimate::add(const TPose2D& odometry, const Scans& scans, double timestamp) {
  unmatched_ = unmatched_ + odometry;
  if (scans.empty()) return;
  if (matched_ > 0 && unmatched_.norm() < kBetween && std::abs(unmatched_.phi) < kTurnBetween) return;
  seen_ = seen_ + scanOdometry_.motionTo(scans, timestamp);
  if (matched_++ > 0) odometry_ = odometry_ + unmatched_;
  unmatched_ = {};
  if (odometry_.norm() >= kStep || std::abs(odometry_.phi) >= kTurnStep) endStep();
}

void MountingEstimate::endStep() {
  const double way = odometry_.norm(), seenWay = seen_.norm();
  if (std::abs(odometry_.phi) >= kTurnStep) {
    if (std::abs(seen_.phi) > 0.5 * std::abs(odometry_.phi)) {
      ++turns_;
      against_ += seen_.phi * odometry_.phi < 0;
    }
  } else if (std::abs(odometry_.phi) < kStraight && std::abs(seen_.phi) < kStraight && seenWay > 0.5 * way &&
             seenWay < 1.5 * way) {
    straight_.push_back({directionOf(odometry_), directionOf(seen_)});
  }
  odometry_ = seen_ = {};
}

std::optional<double> MountingEstimate::direction() const {
  const double mirror = 2 * against_ > turns_ ? -1 : 1;
  std::complex<double> sum;
  for (const Straight& step : straight_) sum += std::polar(1.0, step.expected - mirror * step.seen);
  const double mean = std::arg(sum);
  const auto agreeing = std::count_if(straight_.begin(), straight_.end(), [&](const Straight& step) {
    return std::abs(mrpt::math::wrapToPi(step.expected - mirror * step.seen - mean)) < kWithin;
  });
  if (straight_.size() < kFewestStraight ||
      static_cast<double>(agreeing) < kAgreeing * static_cast<double>(straight_.size()))
    return std::nullopt;
  return mean;
}

std::optional<Mounting> MountingEstimate::mounting() const {
  const auto yaw = direction();
  const size_t agreeing = std::max(against_, turns_ - against_);
  if (!yaw || turns_ < kFewestTurns ||
      static_cast<double>(agreeing) < kAgreeing * static_cast<double>(turns_))
    return std::nullopt;
  return Mounting{*yaw, 2 * against_ > turns_};
}

bool MountingEstimate::isDone() const { return matched_ >= kMostMatched || mounting(); }

}  // namespace hybrid_slam
