#include "io/RawlogSource.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/Errors.h"
#include "rbpf/HybridMapBuilder.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;

namespace {

/// Calls visit for every observation in an object of a rawlog.
template <class Visit>
void forEachObservation(const mrpt::serialization::CSerializable::Ptr& object, const Visit& visit) {
  if (const auto single = std::dynamic_pointer_cast<CObservation>(object)) visit(single);
  if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object))
    for (const auto& observation : *frame) visit(observation);
}

/// The increment of an action; nothing for an object that is none, or an empty one.
std::optional<TPose2D> incrementOf(const mrpt::serialization::CSerializable::Ptr& object) {
  const auto action = std::dynamic_pointer_cast<CActionCollection>(object);
  if (!action || action->size() == 0) return std::nullopt;
  return odometryIncrement(*action);
}

bool isFinite(const TPose2D& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.phi); }

bool hasBeams(const CObservation2DRangeScan& scan) {
  return scan.getScanSize() > 0 && std::isfinite(scan.aperture) &&
         isFinite(TPose2D(scan.sensorPose.asTPose()));
}

void note(Oddity& oddity, size_t entry) {
  if (oddity.count++ == 0) oddity.first = entry;
}

/// MRPT's own code takes the readings of valid beams as they are.
void markInvalidBeams(CObservation2DRangeScan& scan) {
  for (size_t i = 0; i < scan.getScanSize(); ++i) {
    const float range = scan.getScanRange(i);
    if (!std::isfinite(range) || range <= 0 || (scan.maxRange > 0 && range >= scan.maxRange))
      scan.setScanRangeValidity(i, false);
  }
}

/// m between two scans; farther apart are two logs in one file, or odometry that was set back.
constexpr double kMaxStep = 100;

bool isStamped(const CObservation2DRangeScan& scan) { return scan.timestamp != INVALID_TIMESTAMP; }
double seconds(const mrpt::Clock::time_point& t) { return mrpt::Clock::toDouble(t); }

TPose2D interpolate(const TPose2D& a, const TPose2D& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          mrpt::math::wrapToPi(a.phi + share * mrpt::math::wrapToPi(b.phi - a.phi))};
}

}  // namespace

void InputOptions::describe(OptionTable& t) {
  t.add("sensor_label", sensorLabel, "label of the laser to use; empty: that of the first scan in the log");
  t.add("require_odometry", requireOdometry,
        "false: take a log of scans only, as if the odometry said that the robot stands still");
  t.add("max_odometry_gap", maxOdometryGap, 0, 1000, "s",
        "odometry is interpolated at a scan's time between readings no farther apart than this");
}

RawlogSummary summarise(const std::string& file, const InputOptions& options) {
  RawlogSummary summary;
  summary.sensorLabel = options.sensorLabel;
  RawlogReader reader(file);
  std::set<std::string> labels;
  double earliest = 0, latest = 0, last = 0;
  bool isFirst = true;
  const auto noteOdometry = [&](const TPose2D& pose, bool& hasSome) {
    if (isFinite(pose))
      hasSome = true;
    else
      note(summary.wrongOdometry, reader.entry());
  };
  const auto noteScan = [&](const CObservation2DRangeScan& scan) {
    if (labels.empty() && options.sensorLabel.empty()) summary.sensorLabel = scan.sensorLabel;
    labels.insert(scan.sensorLabel);
    if (scan.sensorLabel != summary.sensorLabel) return;
    if (!hasBeams(scan)) return note(summary.empty, reader.entry());
    ++summary.scans;
    if (!isStamped(scan)) return note(summary.unstamped, reader.entry());
    const double t = seconds(scan.timestamp);
    if (!isFirst && t < last) note(summary.stepsBack, reader.entry());
    if (!isFirst && t == last) note(summary.repeatedStamps, reader.entry());
    earliest = isFirst ? t : std::min(earliest, t);
    latest = isFirst ? t : std::max(latest, t);
    last = t;
    isFirst = false;
  };
  while (const auto object = reader.next()) {
    if (const auto increment = incrementOf(object)) noteOdometry(*increment, summary.hasActions);
    forEachObservation(object, [&](const CObservation::Ptr& observation) {
      if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation))
        noteOdometry(odometry->odometry.asTPose(), summary.hasOdometryReadings);
      if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) noteScan(*scan);
    });
  }
  summary.duration = latest - earliest;
  summary.entries = reader.entry();
  summary.defect = reader.defect();

  if (labels.empty())
    throw InputError("no laser scans", file, "expected objects of class CObservation2DRangeScan");
  if (labels.count(summary.sensorLabel) == 0) {
    std::string all;
    for (const std::string& label : labels) all += (all.empty() ? "`" : ", `") + label + "`";
    throw InputError("no scans of the laser `" + summary.sensorLabel + "`", file,
                     "[input] sensor_label: the log has " + all);
  }
  if (summary.scans == 0)
    throw InputError("all scans are of zero length", file, "expected scans with at least one beam");
  if (!summary.hasActions && !summary.hasOdometryReadings && options.requireOdometry)
    throw InputError("no odometry", file,
                     "expected actions or CObservationOdometry; [input] require_odometry = false takes a log "
                     "of scans only");
  return summary;
}

RawlogSource::RawlogSource(const std::string& file, const InputOptions& options, const RawlogSummary& summary)
    : file_(file),
      reader_(file),
      maxOdometryGap_(options.maxOdometryGap),
      sensorLabel_(summary.sensorLabel),
      hasOdometryReadings_(summary.hasOdometryReadings) {}

std::optional<Reading> RawlogSource::next() {
  while (ready_.empty()) {
    const auto object = reader_.next();
    if (object) {
      take(object);
    } else if (!waiting_.empty()) {
      finishWaiting(travelled_);  // no odometry came after these
    } else {
      return std::nullopt;
    }
  }
  Reading reading = ready_.front();
  ready_.pop_front();
  return reading;
}

void RawlogSource::take(const mrpt::serialization::CSerializable::Ptr& object) {
  const auto increment = incrementOf(object);
  if (increment && isFinite(*increment)) travelled_ = travelled_ + *increment;
  forEachObservation(object, [this](const CObservation::Ptr& observation) {
    if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation)) {
      if (isFinite(odometry->odometry.asTPose())) takeOdometry(*odometry);
    } else if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) {
      if (scan->sensorLabel == sensorLabel_ && hasBeams(*scan)) takeScan(scan);
    }
  });
}

void RawlogSource::takeScan(const CObservation2DRangeScan::Ptr& scan) {
  waiting_.push_back(scan);
  if (hasOdometryReadings_ && !lastOdometry_) return;
  const double age = isStamped(*scan) ? seconds(scan->timestamp) - lastOdometryTime_ : 0;
  const bool mayLieBetween = hasOdometryReadings_ && age > 0 && age <= maxOdometryGap_;
  // Nobody waits longer than the gap, so that memory does not grow where odometry ends before the scans do.
  if (!mayLieBetween && (waiting_.size() == 1 || age > maxOdometryGap_)) finishWaiting(travelled_);
}

void RawlogSource::takeOdometry(const CObservationOdometry& odometry) {
  const TPose2D pose = odometry.odometry.asTPose();
  const bool isStampedOdometry = odometry.timestamp != INVALID_TIMESTAMP;
  const double time = isStampedOdometry ? seconds(odometry.timestamp) : lastOdometryTime_;
  for (const auto& scan : waiting_) {
    const double t = isStamped(*scan) ? seconds(scan->timestamp) : lastOdometryTime_;
    if (!lastOdometry_)
      finish(scan, pose);
    else if (lastOdometryTime_ < t && t <= time && time - lastOdometryTime_ <= maxOdometryGap_)
      finish(scan, interpolate(*lastOdometry_, pose, (t - lastOdometryTime_) / (time - lastOdometryTime_)));
    else
      finish(scan, *lastOdometry_);
  }
  waiting_.clear();
  lastOdometry_ = travelled_ = pose;
  lastOdometryTime_ = time;
}

void RawlogSource::finishWaiting(const TPose2D& odometry) {
  for (const auto& scan : waiting_) finish(scan, odometry);
  waiting_.clear();
}

void RawlogSource::finish(const CObservation2DRangeScan::Ptr& scan, const TPose2D& odometry) {
  markInvalidBeams(*scan);
  Reading reading;
  reading.scan = scan;
  if (isStamped(*scan)) lastTimestamp_ = seconds(scan->timestamp);
  reading.timestamp = lastTimestamp_;
  if (!first_) reading.motion = odometry - atLastScan_;
  if (reading.motion.norm() > kMaxStep)
    throw InputError("odometry jumps", "entry " + std::to_string(reader_.entry()) + " of " + file_,
                     "expected at most 100 m between two scans");
  first_ = false;
  atLastScan_ = odometry;
  ready_.push_back(reading);
}

}  // namespace hybrid_slam
