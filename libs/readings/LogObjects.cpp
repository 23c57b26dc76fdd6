#include "readings/LogObjects.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/ObjectWalk.h"
#include "readings/ReadingAssembler.h"

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
  observation->resizeScan(beams);
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
  if (jumps_.isJump(record.pose, record.time))
    ++summary.odometryJumps;
  else if (last_)
    summary.pathLength += std::hypot(record.pose.x - last_->pose.x, record.pose.y - last_->pose.y);
  last_ = record;
  ++summary.odometryReadings;
  seenAt(record.time);
  if (actionObservation_) return;
  auto observation = mrpt::obs::CObservationOdometry::Create();
  observation->timestamp = mrpt::Clock::fromDouble(record.time);
  observation->sensorLabel = "ODOMETRY";
  observation->odometry = mrpt::poses::CPose2D(record.pose);
  ready_.push_back(observation);
}

void LogObjects::operator()(const LaserRecord& record) {
  if (record.odometry && !(last_ && last_->time == record.time && last_->pose == *record.odometry))
    (*this)(OdometryRecord{record.time, *record.odometry});
  ++summary.scans;
  seenAt(record.time);
  for (const auto range : record.ranges)
    if (range > 0 && std::isfinite(range)) ++summary.ranges, summary.rangesBeyond += range >= maxRange_;
  const auto observation = observationOf(record, maxRange_);
  const double sweep = sweepSetting_.of(observation->aperture).value_or(record.sweep);
  summary.wrongSweeps += !isSweepTime(sweep);
  const double sweepBefore = std::exchange(sweeps_[observation->sensorLabel], sweep);
  const auto comment =
      sweepBefore == sweep ? nullptr : commentOf({observation->sensorLabel, sweep}, observation->timestamp);
  for (size_t i = 0; i < observation->getScanSize(); ++i)
    if (observation->getScanRangeValidity(i))
      summary.longestRange = std::max(summary.longestRange, observation->getScanRange(i));
  if (actionObservation_) {
    writeActionUpTo(record.time);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    if (comment) frame->insert(comment);
    frame->insert(observation);
    ready_.push_back(frame);
  } else {
    if (comment) ready_.push_back(comment);
    ready_.push_back(observation);
  }
}

/// Writes the odometry increment since the previous scan; an empty action if there is none.
void LogObjects::writeActionUpTo(double time) {
  auto actions = mrpt::obs::CActionCollection::Create();
  if (last_) {
    mrpt::obs::CActionRobotMovement2D movement;
    movement.timestamp = mrpt::Clock::fromDouble(time);
    const mrpt::poses::CPose2D now(last_->pose);
    movement.computeFromOdometry(now - atLastScan_.value_or(now), movement.motionModelConfiguration);
    actions->insert(movement);
    atLastScan_ = now;
  }
  ready_.push_back(actions);
}

void LogObjects::seenAt(double time) {
  const bool first = summary.scans + summary.odometryReadings == 1;
  constexpr double kDay = 86400;  // s
  if (!first && std::abs(time - lastTime_) > kDay) ++summary.timeJumps;
  lastTime_ = time;
  summary.earliest = first ? time : std::min(summary.earliest, time);
  summary.latest = first ? time : std::max(summary.latest, time);
}

}  // namespace hybrid_slam::readings
