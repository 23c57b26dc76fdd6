#include "readings/RawlogLog.h"

#include <algorithm>
#include <limits>

#include "base/Errors.h"
#include "files/ObjectLayouts.h"
#include "readings/ReadingAssembler.h"
#include "readings/Timestamps.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

bool hasOdometryReadings(const std::string& file) {
  files::RawlogReader reader(file);
  bool hasSome = false;
  while (const auto object = hasSome ? nullptr : reader.next())
    forEachObservation(object, [&](const CObservation::Ptr& observation) {
      const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation);
      hasSome = hasSome || (odometry && isPossible(odometry->odometry.asTPose()));
    });
  return hasSome;
}

/// Makes readings at or beyond a range (m) no returns.
void limitRange(CObservation2DRangeScan& scan, double range) {
  const auto limit = static_cast<float>(range);
  scan.maxRange = scan.maxRange > 0 ? std::min(scan.maxRange, limit) : limit;
  for (size_t i = 0; i < scan.getScanSize(); ++i)
    if (scan.getScanRange(i) >= scan.maxRange) scan.setScanRangeValidity(i, false);
}

}  // namespace

RawlogLog::RawlogLog(const std::string& file, const LogConversionOptions& options)
    : objects_(options.maxRange.value_or(LogObjects::kAnyRange), options.actionObservation, options.sweep),
      file_(file),
      options_(options),
      reader_(file),
      hasOdometryReadings_(hasOdometryReadings(file)) {
  objects_.summary.format = "rawlog";
  objects_.summary.unit = "entry";
}

mrpt::serialization::CSerializable::Ptr RawlogLog::next() {
  auto object = objects_.take();
  while (!object) {
    const auto read = reader_.next();
    if (!read) break;
    take(read);
    objects_.summary.areAt(reader_.entry());
    object = objects_.take();
  }
  if (!object && summary().scans == 0)
    throw InputError("no laser scans", file_, "expected objects of class CObservation2DRangeScan");
  return object;
}

void RawlogLog::take(const mrpt::serialization::CSerializable::Ptr& object) {
  if (const auto observation = std::dynamic_pointer_cast<CObservation>(object)) {
    prepare(observation);
    return take(observation, nullptr);
  }
  if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object)) return takeFrame(*frame);
  const auto increment = incrementOf(object);
  if (increment && !hasOdometryReadings_) {
    const TPose2D sum = travelled_.value_or(TPose2D()) + *increment;
    if (isFinite(sum)) travelled_ = sum;
  }
  if (options_.actionObservation) objects_.keep(object);
}

void RawlogLog::takeFrame(const CSensoryFrame& frame) {
  if (travelled_) {
    const auto stamped = std::find_if(frame.begin(), frame.end(),
                                      [](const CObservation::Ptr& one) { return isStamped(*one); });
    const auto time = stamped == frame.end() ? INVALID_TIMESTAMP : (*stamped)->timestamp;
    const auto odometry = odometryAt(time, *travelled_);
    objects_.odometry({timeOf(*odometry).value_or(kUnknown), *travelled_}, odometry);
  }
  const auto kept = options_.actionObservation ? CSensoryFrame::Create() : nullptr;
  for (const CObservation::Ptr& observation : frame) prepare(observation);
  for (const CObservation::Ptr& observation : frame) take(observation, kept.get());
  if (kept) objects_.keep(kept);
}

void RawlogLog::prepare(const CObservation::Ptr& observation) {
  if (const auto sweep = sweepTimeIn(*observation)) {
    sweeps_.take(*sweep);
    objects_.summary.wrongSweeps += !isSweepTime(sweep->seconds);
  }
  const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation);
  if (scan && options_.maxRange) limitRange(*scan, *options_.maxRange);
}

void RawlogLog::take(const CObservation::Ptr& observation, CSensoryFrame* frame) {
  if (sweepTimeIn(*observation)) return;  // LogObjects states it again
  const double time = timeOf(*observation).value_or(kUnknown);
  if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) {
    const double sweep = sweeps_.of(*scan);
    if (!frame) return objects_.scan(scan, time, sweep);
    if (const auto comment = objects_.note(*scan, time, sweep)) frame->insert(comment);
  } else if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation)) {
    const TPose2D pose = odometry->odometry.asTPose();
    if (!isFinite(pose)) return objects_(OtherRecord{"odometry readings that are not numbers"});
    objects_.odometry({time, pose}, odometry);
  } else if (!frame && options_.actionObservation) {
    return objects_(OtherRecord{std::string(files::baseName(observation->GetRuntimeClass()->className))});
  } else if (!frame) {
    objects_.keep(observation);
  }
  if (frame) frame->insert(observation);
}

std::vector<std::string> RawlogLog::notes() const {
  if (reader_.passedOver() == 0) return {};
  std::string classes;
  for (const std::string& name : reader_.passedOverClasses()) classes += (classes.empty() ? "" : ", ") + name;
  return {std::to_string(reader_.passedOver()) + " observations of classes that are not read (" + classes +
          "): first at entry " + std::to_string(reader_.firstPassedOver()) + " of " + file_ + "; skipped"};
}

}  // namespace hybrid_slam::readings
