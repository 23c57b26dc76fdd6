#include "readings/LogObjects.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Memory.h"
#include "files/ObjectWalk.h"
#include "readings/ReadingAssembler.h"
#include "readings/Timestamps.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::obs::CObservation2DRangeScan;

/// Pose of a sensor whose x axis is the middle of the fan.
mrpt::poses::CPose3D sensorPoseOf(const LaserRecord& record) {
  const double middle =
      record.angles.first + static_cast<double>(record.ranges.size() - 1) * record.angles.step / 2;
  if (record.mounting)
    return mrpt::poses::CPose3D(*record.mounting) + mrpt::poses::CPose3D(0, 0, 0, middle, 0, 0);
  return {record.laserPose.x, record.laserPose.y, 0, record.laserPose.phi + middle, 0, 0};
}

CObservation2DRangeScan::Ptr observationOf(const LaserRecord& record, double maxRange) {
  auto observation = CObservation2DRangeScan::Create();
  observation->timestamp = mrpt::Clock::fromDouble(record.time);
  observation->sensorLabel = record.label.substr(0, files::kLongestLabel);  // longer ones are not read back
  observation->maxRange = static_cast<float>(std::min(maxRange, record.maxRange.value_or(maxRange)));
  observation->rightToLeft = record.angles.step >= 0;
  const size_t beams = record.ranges.size();
  observation->aperture = static_cast<float>(static_cast<double>(beams - 1) * std::abs(record.angles.step));
  observation->sensorPose = sensorPoseOf(record);
  resizeScan(*observation, beams);
  for (size_t i = 0; i < beams; ++i) {
    const float range = record.ranges[i];
    // NaN in a rawlog would reach programs that ignore the validity flags.
    observation->setScanRange(i, std::isfinite(range) ? range : 0);
    observation->setScanRangeValidity(i,
                                      range > 0 && range >= record.minRange && range < observation->maxRange);
  }
  return observation;
}

}  // namespace

mrpt::obs::CObservationOdometry::Ptr odometryAt(mrpt::Clock::time_point time,
                                                const mrpt::math::TPose2D& pose) {
  auto observation = mrpt::obs::CObservationOdometry::Create();
  observation->timestamp = time;
  observation->sensorLabel = "ODOMETRY";
  observation->odometry = mrpt::poses::CPose2D(pose);
  return observation;
}

/// A file that is not a log may have any number of names.
void LogObjects::operator()(const OtherRecord& record) {
  constexpr size_t kMostNames = 100;
  auto& counts = summary.otherRecords;
  const bool isKept = counts.size() < kMostNames || counts.count(record.name) > 0;
  ++counts[isKept ? record.name : "of other names"];
}

mrpt::serialization::CSerializable::Ptr LogObjects::take() {
  if (ready_.empty()) return nullptr;
  auto object = ready_.front();
  ready_.pop_front();
  return object;
}

void LogObjects::operator()(const OdometryRecord& record) {
  odometry(record, odometryAt(mrpt::Clock::fromDouble(record.time), record.pose));
}

void LogObjects::odometry(const OdometryRecord& record,
                          const mrpt::obs::CObservationOdometry::Ptr& observation) {
  const bool isRight = isPossible(record.pose);
  if (!isRight)
    ++summary.impossibleOdometry.count;
  else if (jumps_.isJump(record.pose, std::isnan(record.time) ? std::nullopt : std::optional(record.time)))
    ++summary.odometryJumps.count;
  else if (lastPossible_)
    summary.pathLength += std::hypot(record.pose.x - lastPossible_->x, record.pose.y - lastPossible_->y);
  if (isRight) lastPossible_ = record.pose;
  last_ = record;
  ++summary.odometryReadings;
  seenAt(record.time);
  if (!actionObservation_) ready_.push_back(observation);
}

void LogObjects::operator()(const LaserRecord& record) {
  if (record.odometry && !(last_ && last_->time == record.time && last_->pose == *record.odometry))
    (*this)(OdometryRecord{record.time, *record.odometry});
  scan(observationOf(record, maxRange_), record.time, record.sweep);
}

void LogObjects::scan(const CObservation2DRangeScan::Ptr& scan, double time, double sweep) {
  const auto comment = note(*scan, time, sweep);
  if (actionObservation_) {
    writeActionUpTo(scan->timestamp);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    if (comment) frame->insert(comment);
    frame->insert(scan);
    ready_.push_back(frame);
  } else {
    if (comment) ready_.push_back(comment);
    ready_.push_back(scan);
  }
}

mrpt::obs::CObservation::Ptr LogObjects::note(const CObservation2DRangeScan& scan, double time,
                                              double sweep) {
  ++summary.scans;
  seenAt(time);
  for (size_t i = 0; i < scan.getScanSize(); ++i) {
    const float range = scan.getScanRange(i);
    if (range > 0 && std::isfinite(range)) ++summary.ranges, summary.rangesBeyond += range >= maxRange_;
    if (scan.getScanRangeValidity(i)) summary.longestRange = std::max(summary.longestRange, range);
  }
  sweep = sweepSetting_.of(scan.aperture).value_or(sweep);
  summary.wrongSweeps += !isSweepTime(sweep);
  if (sweeps_.size() >= kMostLabels && sweeps_.count(scan.sensorLabel) == 0) return nullptr;
  const double before = std::exchange(sweeps_[scan.sensorLabel], sweep);
  return before == sweep ? nullptr : commentOf({scan.sensorLabel, sweep}, scan.timestamp);
}

/// Writes the odometry increment since the previous scan; an empty action if there is none.
void LogObjects::writeActionUpTo(mrpt::Clock::time_point time) {
  auto actions = mrpt::obs::CActionCollection::Create();
  if (last_) {
    mrpt::obs::CActionRobotMovement2D movement;
    movement.timestamp = time;
    const mrpt::poses::CPose2D now(last_->pose);
    movement.computeFromOdometry(now - atLastScan_.value_or(now), movement.motionModelConfiguration);
    actions->insert(movement);
    atLastScan_ = now;
  }
  ready_.push_back(actions);
}

void LogObjects::seenAt(double time) {
  if (std::isnan(time)) return;
  if (lastTime_ && std::abs(time - *lastTime_) > kDay) ++summary.timeJumps.count;
  summary.earliest = lastTime_ ? std::min(summary.earliest, time) : time;
  summary.latest = lastTime_ ? std::max(summary.latest, time) : time;
  lastTime_ = time;
}

}  // namespace hybrid_slam::readings
