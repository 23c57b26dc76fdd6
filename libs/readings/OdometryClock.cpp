#include "readings/OdometryClock.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>

#include "readings/Timestamps.h"

namespace hybrid_slam::readings {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;

namespace {

constexpr size_t kMostDelayed = 10'000, kMostDelayedBeams = 10'000'000;
constexpr double kStepBack = 1;  // s; a longer one begins another log

/// An observation without a time follows the one before.
double timeOrEarliest(const CObservation& observation) {
  return timeOf(observation).value_or(-std::numeric_limits<double>::infinity());
}

size_t beamsOf(const CObservation& observation) {
  const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation);
  return scan ? scan->getScanSize() : 0;
}

}  // namespace

std::vector<CObservation::Ptr> OdometryClock::take(const CObservation::Ptr& observation) {
  if (offset_ == 0) return {observation};
  std::vector<CObservation::Ptr> released;
  const double stamp = timeOf(*observation).value_or(now_);
  if (stamp < now_ - std::abs(offset_) - kStepBack) {
    released = finish();
    now_ = stamp;
  }
  now_ = std::max(now_, stamp);
  CObservation::Ptr current = observation;
  const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation);
  if (odometry && isStamped(*odometry)) {
    current = CObservationOdometry::Create(*odometry);  // a recording has it as measured
    // Times of text logs may begin at zero, and negative ones would overflow.
    current->timestamp = mrpt::Clock::fromDouble(std::max(stamp + offset_, 0.0));
  }
  const bool isLate = offset_ < 0;  // scans wait for late odometry, early odometry waits for scans
  if (isLate == static_cast<bool>(odometry)) {
    release(timeOrEarliest(*current), !odometry, released);  // at equal times odometry is first
    released.push_back(current);
  } else {
    held_.push_back(current);
    heldBeams_ += beamsOf(*current);
  }
  release(isLate ? now_ + offset_ : now_, true, released);
  return released;
}

std::vector<CObservation::Ptr> OdometryClock::finish() {
  std::vector<CObservation::Ptr> released;
  release(std::numeric_limits<double>::infinity(), true, released);
  return released;
}

void OdometryClock::release(double time, bool isInclusive, std::vector<CObservation::Ptr>& released) {
  const auto mayContinue = [&](double t) { return t < time || (isInclusive && t == time); };
  while (!held_.empty() && (mayContinue(timeOrEarliest(*held_.front())) || held_.size() > kMostDelayed ||
                            heldBeams_ > kMostDelayedBeams)) {
    heldBeams_ -= beamsOf(*held_.front());
    released.push_back(held_.front());
    held_.pop_front();
  }
}

}  // namespace hybrid_slam::readings
