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
constexpr double kStraight = 3 * kDegree;  // turned in a straight step: less
constexpr size_t kMostMatched = 500;
constexpr size_t kFewestSteps = 20;
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
  if (std::abs(odometry_.phi) < kStraight && std::abs(seen_.phi) < kStraight && seenWay > 0.5 * way &&
      seenWay < 1.5 * way)
    yaws_.push_back(directionOf(odometry_) - directionOf(seen_));
  odometry_ = seen_ = {};
}

std::optional<double> MountingEstimate::yaw() const {
  if (yaws_.size() < kFewestSteps) return std::nullopt;
  std::complex<double> sum;
  for (const double yaw : yaws_) sum += std::polar(1.0, yaw);
  const double mean = std::arg(sum);
  const auto agreeing = std::count_if(yaws_.begin(), yaws_.end(), [mean](double yaw) {
    return std::abs(mrpt::math::wrapToPi(yaw - mean)) < kWithin;
  });
  if (static_cast<double>(agreeing) < kAgreeing * static_cast<double>(yaws_.size())) return std::nullopt;
  return mean;
}

bool MountingEstimate::isDone() const { return matched_ >= kMostMatched || yaw(); }

}  // namespace hybrid_slam
