#include "live/CycleGrouper.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>

namespace hybrid_slam::live {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;

namespace {

size_t beamsOf(const CObservation& observation) {
  const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation);
  return scan ? scan->getScanSize() : 0;
}

}  // namespace

void CycleGrouper::add(const CObservation::Ptr& observation) {
  const bool isStamped = observation->timestamp != INVALID_TIMESTAMP;
  const double time = isStamped ? mrpt::Clock::toDouble(observation->timestamp) : newest_.value_or(0);
  if (newest_ && time < *newest_ - kLongestWait) {
    finish();
    newest_.reset(), lastOdometry_.reset();
  }
  newest_ = std::max(newest_.value_or(time), time);

  if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) {
    if (!isDue(*scan, time)) return;
  } else if (std::dynamic_pointer_cast<CObservationOdometry>(observation)) {
    lastOdometry_ = std::max(lastOdometry_.value_or(time), time);
  }
  insert(time, observation);

  // The cycle ends with the last ready scan and the first odometry at or after it.
  for (size_t i = waiting_.size(); i-- > 0;) {
    if (!std::dynamic_pointer_cast<CObservation2DRangeScan>(waiting_[i].observation)) continue;
    const double scanTime = waiting_[i].time;
    const bool comesOdometry = lastOdometry_ && scanTime - *lastOdometry_ <= kLongestWait;
    size_t end = i + 1;
    if (lastOdometry_ && *lastOdometry_ >= scanTime) {
      const bool isBefore = i > 0 && waiting_[i - 1].time == scanTime &&
                            std::dynamic_pointer_cast<CObservationOdometry>(waiting_[i - 1].observation);
      const auto isOdometry = [](const Entry& e) {
        return static_cast<bool>(std::dynamic_pointer_cast<CObservationOdometry>(e.observation));
      };
      const auto after =
          std::find_if(waiting_.begin() + static_cast<std::ptrdiff_t>(i), waiting_.end(), isOdometry);
      if (!isBefore && after != waiting_.end()) end = static_cast<size_t>(after - waiting_.begin()) + 1;
    } else if (comesOdometry && *newest_ - scanTime <= kLongestWait) {
      continue;
    }
    return give(end);
  }
  if (*newest_ - waiting_.front().time > kLongestWait || waiting_.size() >= kMostWaiting ||
      waitingBeams_ >= kMostWaitingBeams)
    give(waiting_.size());
}

/// Scans at about the cycle rate all pass despite jitter; faster ones are thinned out. A laser whose clock
/// was set back by more than a period starts again; those of the others do not matter.
bool CycleGrouper::isDue(const CObservation2DRangeScan& scan, double time) {
  if (period_ == 0) return true;
  if (due_.size() >= kMostLasers && due_.count(scan.sensorLabel) == 0) return false;
  const auto due = due_.try_emplace(scan.sensorLabel, time).first;
  if (due->second - time > 2.5 * period_) due->second = time;
  if (time < due->second - period_ / 2) return false;
  due->second = std::max(due->second, time - period_ / 2) + period_;
  return true;
}

void CycleGrouper::insert(double time, const CObservation::Ptr& observation) {
  const auto after = std::upper_bound(waiting_.begin(), waiting_.end(), time,
                                      [](double t, const Entry& entry) { return t < entry.time; });
  waiting_.insert(after, {time, observation});
  waitingBeams_ += beamsOf(*observation);
}

void CycleGrouper::give(size_t count) {
  auto cycle = mrpt::obs::CSensoryFrame::Create();
  for (size_t i = 0; i < count; ++i) {
    cycle->insert(waiting_[i].observation);
    waitingBeams_ -= beamsOf(*waiting_[i].observation);
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
  sink_(cycle);
}

void CycleGrouper::finish() {
  if (!waiting_.empty()) give(waiting_.size());
}

}  // namespace hybrid_slam::live
