#include "readings/ReadingAssembler.h"

#include <mrpt/obs/CActionCollection.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/DeskewedScan.h"
#include "base/Errors.h"
#include "base/OdometryIncrement.h"
#include "readings/Timestamps.h"

namespace hybrid_slam::readings {

using mrpt::math::TPose2D;
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;

namespace {

constexpr size_t kMostWaiting = 1000;  // scans
constexpr size_t kMostWaitingBeams = 10'000'000;
constexpr double kFarthestApart = 10;  // m between the scans of one reading

/// Marks invalid beams, because MRPT uses valid ones unchecked.
void markInvalidBeams(CObservation2DRangeScan& scan, double minRange) {
  for (size_t i = 0; i < scan.getScanSize(); ++i)
    if (!isReturn(scan, i) || scan.getScanRange(i) < minRange) scan.setScanRangeValidity(i, false);
}

}  // namespace

bool isAction(const mrpt::serialization::CSerializable::Ptr& object) {
  const auto action = std::dynamic_pointer_cast<CActionCollection>(object);
  return action && action->size() > 0;
}

std::optional<TPose2D> incrementOf(const mrpt::serialization::CSerializable::Ptr& object) {
  if (!isAction(object)) return std::nullopt;
  try {
    return odometryIncrement(dynamic_cast<const CActionCollection&>(*object));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool isFinite(const TPose2D& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.phi); }

bool isReturn(const CObservation2DRangeScan& scan, size_t beam) {
  const float range = scan.getScanRange(beam);
  return scan.getScanRangeValidity(beam) && std::isfinite(range) && range > 0 &&
         !(scan.maxRange > 0 && range >= scan.maxRange);
}

bool hasBeams(const CObservation2DRangeScan& scan) {
  return scan.getScanSize() > 0 && std::isfinite(scan.aperture) &&
         isFinite(TPose2D(scan.sensorPose.asTPose()));
}

ReadingAssembler::ReadingAssembler(const std::vector<std::string>& lasers, OdometrySource odometry,
                                   double maxOdometryGap, SensorSettings settings,
                                   const std::string& odometryLabel)
    : grouper_(lasers, maxOdometryGap, settings.pose.has_value()),
      settings_(std::move(settings)),
      odometryClock_(odometry == OdometrySource::readings ? settings_.odometryTimeOffset : 0),
      track_(maxOdometryGap),
      maxOdometryGap_(maxOdometryGap),
      source_(odometry) {
  if (!odometryLabel.empty()) odometryLabel_ = odometryLabel;
}

std::optional<Reading> ReadingAssembler::next() {
  if (ready_.empty()) return std::nullopt;
  Reading reading = ready_.front();
  ready_.pop_front();
  return reading;
}

void ReadingAssembler::take(const mrpt::serialization::CSerializable::Ptr& object) {
  const auto increment = incrementOf(object);
  if (increment && source_ == OdometrySource::actions && isFinite(*increment)) {
    if (isJump({}, *increment))
      ++jumps_;
    else
      travelled_ = travelled_ + *increment;
    travel();
  }
  isInTrack_ = false;
  forEachObservation(object, [this](const CObservation::Ptr& observation) {
    if (const auto sweep = sweepTimeIn(*observation)) settings_.sweeps.take(*sweep);
    if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation))
      if (grouper_.useOf(*scan) == ScanGrouper::Use::taken) grouper_.expect(scan->sensorLabel);
  });
  forEachObservation(object, [this](const CObservation::Ptr& observation) {
    const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation);
    const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation);
    if ((scan && grouper_.useOf(*scan) == ScanGrouper::Use::taken) ||
        (odometry && hasOdometryReadings() && isPossible(odometry->odometry.asTPose()) &&
         isOfUsedSensor(*odometry))) {
      if (scan) {
        const size_t reading = grouper_.add(*scan);
        places_.push_back({reading, grouper_.isComplete()});
      }
      for (const CObservation::Ptr& next : odometryClock_.take(observation)) takeInOrder(next);
    }
  });
}

void ReadingAssembler::takeInOrder(const CObservation::Ptr& observation) {
  if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation))
    takeScan(scan);
  else
    takeOdometry(dynamic_cast<const CObservationOdometry&>(*observation));
}

void ReadingAssembler::travel() {
  constexpr double kStep = 0.05;  // the odometry of a robot that stands may tremble
  const double step = (travelled_ - travelledTo_).norm();
  if (step < kStep) return;
  way_ += step;
  travelledTo_ = travelled_;
}

void ReadingAssembler::takeScan(CObservation2DRangeScan::Ptr scan) {
  if (settings_.pose) {
    scan = copyOf(*scan);  // a recording has it as measured
    scan->sensorPose = *settings_.pose;
  }
  if (!hasOdometryReadings() && !isInTrack_ && isStamped(*scan)) {
    track_.add(seconds(scan->timestamp), travelled_);
    isInTrack_ = true;
    completeReady();
  }
  const auto [reading, endsReading] = places_.front();
  places_.pop_front();
  waiting_.push_back({scan, reading, endsReading, settings_.sweeps.of(*scan)});
  if (hasOdometryReadings() && !lastOdometry_) {
    while (waiting_.back().reading - waiting_.front().reading >= kMostEarly ||
           (waiting_.size() > 1 && hasManyBeams()))
      waiting_.pop_front();
    dropped_ = waiting_.front().reading - 1;
    return;
  }
  const bool isFull = waiting_.size() >= kMostWaiting || hasManyBeams();
  const double age = isStamped(*scan) ? seconds(scan->timestamp) - lastOdometryTime_ : 0;
  const bool mayLieBetween = hasOdometryReadings() && age > 0 && age <= maxOdometryGap_;
  // No scan waits longer than the gap, so that memory stays bounded if odometry ends before the scans. The
  // count bounds it where time stands still.
  const bool isLong = (hasOdometryReadings() && age > maxOdometryGap_) || isFull;
  if (isLong) return finishWaiting();
  if (hasOdometryReadings() && age < 0 && track_.contains(seconds(scan->timestamp)))  // after newer odometry
    waiting_.back().odometry = track_.at(seconds(scan->timestamp));
  else if (!hasOdometryReadings() || (!mayLieBetween && waiting_.size() == 1))
    waiting_.back().odometry = travelled_;
  completeReady();
}

bool ReadingAssembler::hasManyBeams() const {
  size_t beams = 0;
  for (const Waiting& waiting : waiting_) beams += waiting.scan->getScanSize();
  return beams >= kMostWaitingBeams;
}

bool ReadingAssembler::isOfUsedSensor(const CObservationOdometry& odometry) {
  if (!odometryLabel_) odometryLabel_ = odometry.sensorLabel;
  return odometry.sensorLabel == *odometryLabel_;
}

void ReadingAssembler::takeOdometry(const CObservationOdometry& odometry) {
  const TPose2D pose = withoutJumps(odometry);
  const bool isStampedOdometry = isStamped(odometry);
  const double time = isStampedOdometry ? seconds(odometry.timestamp) : lastOdometryTime_;
  for (Waiting& scan : waiting_) {
    if (scan.odometry) continue;
    const double t = isStamped(*scan.scan) ? seconds(scan.scan->timestamp) : lastOdometryTime_;
    const bool isOlder =
        isStampedOdometry && lastOdometryTime_ <= time && time < t && t - time <= maxOdometryGap_;
    if (lastOdometry_ && isOlder) continue;  // the next reading may be newer than the scan
    if (!lastOdometry_)
      scan.odometry = pose;
    else if (lastOdometryTime_ < t && t <= time && time - lastOdometryTime_ <= maxOdometryGap_)
      scan.odometry = interpolate(*lastOdometry_, pose, (t - lastOdometryTime_) / (time - lastOdometryTime_));
    else
      scan.odometry = *lastOdometry_;
  }
  if (!lastOdometry_) travelledTo_ = pose;
  lastOdometry_ = travelled_ = pose;
  travel();
  lastOdometryTime_ = time;
  track_.add(time, pose);
  completeReady();
}

TPose2D ReadingAssembler::withoutJumps(const CObservationOdometry& odometry) {
  const TPose2D reading = odometry.odometry.asTPose();
  const TPose2D before = lastReading_.value_or(reading);
  lastReading_ = reading;
  const bool isAJump = odometryJumps_.isJump(reading, timeOf(odometry));
  jumps_ += isAJump ? 1 : 0;
  if (jumps_ == 0 || !lastOdometry_) return reading;
  return isAJump ? *lastOdometry_ : *lastOdometry_ + (reading - before);
}

bool ReadingAssembler::isReady(const Waiting& scan) const {
  if (!scan.odometry || scan.sweep == 0) return scan.odometry.has_value();
  const double time = seconds(scan.scan->timestamp);
  const bool mayBeCorrected = track_.mayReach(time) || track_.mayReach(time + scan.sweep);
  return !mayBeCorrected || track_.end() >= time + scan.sweep;
}

void ReadingAssembler::completeReady() {
  for (; !waiting_.empty() && isReady(waiting_.front()); waiting_.pop_front()) complete(waiting_.front());
}

void ReadingAssembler::finishWaiting() {
  for (Waiting& scan : waiting_) {
    if (!scan.odometry) scan.odometry = travelled_;
    complete(scan);
  }
  waiting_.clear();
}

bool ReadingAssembler::isEarly(const Waiting& scan) const {
  if (scan.sweep == 0) return false;
  const double time = seconds(scan.scan->timestamp);
  return !track_.contains(time) && track_.contains(time + scan.sweep);
}

CObservation2DRangeScan::Ptr ReadingAssembler::corrected(const Waiting& scan) const {
  const double time = scan.sweep > 0 ? seconds(scan.scan->timestamp) : 0;
  if (scan.sweep == 0 || !(track_.contains(time) || isEarly(scan))) return scan.scan;
  const TPose2D start = track_.at(time);
  const size_t beams = scan.scan->getScanSize();
  std::vector<TPose2D> motion;
  motion.reserve(beams);
  for (size_t i = 0; i < beams; ++i)
    motion.push_back(track_.at(time + scan.sweep * static_cast<double>(i) / static_cast<double>(beams - 1)) -
                     start);
  const bool stands =
      std::all_of(motion.begin(), motion.end(), [](const TPose2D& m) { return m == TPose2D(); });
  return stands ? scan.scan : deskew(*scan.scan, motion);
}

void ReadingAssembler::complete(const Waiting& scan) {
  const TPose2D odometry = isEarly(scan) ? track_.at(seconds(scan.scan->timestamp)) : *scan.odometry;
  if (scan.reading != current_) endReading();
  current_ = scan.reading;
  // Wrong odometry may move a robot far between two lasers: only the latest scans are one reading.
  if (!collected_.empty() && !((odometry - collected_.back().second).norm() <= kFarthestApart))
    collected_.clear();
  markInvalidBeams(*scan.scan, settings_.minRange);
  if (frozenLasers_.isFrozen(scan.scan, odometry))
    repeated_ = {scan.scan, odometry};
  else
    collected_.emplace_back(corrected(scan), odometry);
  if (scan.endsReading) endReading();
}

void ReadingAssembler::endReading() {
  if (collected_.empty() && !repeated_) return;
  const auto [latest, odometry] = collected_.empty() ? *repeated_ : collected_.back();
  Reading reading;
  for (const auto& [scan, before] : collected_) {
    const TPose2D moved = before - odometry;  // where the robot was, seen from where it is
    reading.scans.push_back(scan);
    if (moved == TPose2D()) continue;
    reading.scans.back() = copyOf(*scan);
    reading.scans.back()->sensorPose = mrpt::poses::CPose3D(moved) + scan->sensorPose;
  }
  if (isStamped(*latest)) lastTimestamp_ = seconds(latest->timestamp);
  reading.timestamp = lastTimestamp_;
  if (repeated_) reading.repeating = repeated_->first->sensorLabel;
  if (!first_) reading.motion = odometry - atLastReading_, reading.way = way_;
  way_ = 0;
  first_ = false;
  atLastReading_ = odometry;
  ready_.push_back(reading);
  collected_.clear();
  repeated_.reset();
}

void ReadingAssembler::finish() {
  for (const CObservation::Ptr& next : odometryClock_.finish()) takeInOrder(next);
  if (hasOdometryReadings() && !lastOdometry_) return;
  finishWaiting();
  endReading();
}

}  // namespace hybrid_slam::readings
