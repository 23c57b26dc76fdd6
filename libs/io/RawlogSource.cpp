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
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;

namespace {

/// Calls visit for every laser scan in an object of a rawlog.
template <class Visit>
void forEachScan(const mrpt::serialization::CSerializable::Ptr& object, const Visit& visit) {
  if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) {
    visit(scan);
  } else if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object)) {
    for (const auto& observation : *frame)
      if (const auto inFrame = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation))
        visit(inFrame);
  }
}

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
  bool stamped = false;
  while (const auto object = reader.next()) {
    summary.hasOdometry |= std::dynamic_pointer_cast<CObservationOdometry>(object) ||
                           std::dynamic_pointer_cast<CActionCollection>(object);
    forEachScan(object, [&](const CObservation2DRangeScan::Ptr& scan) {
      if (labels.empty() && options.sensorLabel.empty()) summary.sensorLabel = scan->sensorLabel;
      labels.insert(scan->sensorLabel);
      if (scan->sensorLabel != summary.sensorLabel) return;
      if (scan->getScanSize() == 0) {
        if (summary.emptyScans++ == 0) summary.firstEmpty = reader.entry();
        return;
      }
      ++summary.scans;
      if (!isStamped(*scan)) {
        if (summary.unstampedScans++ == 0) summary.firstUnstamped = reader.entry();
        return;
      }
      const double t = seconds(scan->timestamp);
      if (stamped && t < last && summary.stepsBack++ == 0) summary.firstStepBack = reader.entry();
      earliest = stamped ? std::min(earliest, t) : t;
      latest = stamped ? std::max(latest, t) : t;
      last = t;
      stamped = true;
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
  if (!summary.hasOdometry && options.requireOdometry)
    throw InputError("no odometry", file,
                     "expected actions or CObservationOdometry; [input] require_odometry = false takes a log "
                     "of scans only");
  return summary;
}

RawlogSource::RawlogSource(const std::string& file, const InputOptions& options, const RawlogSummary& summary)
    : reader_(file), options_(options), sensorLabel_(summary.sensorLabel) {
  options_.requireOdometry = summary.hasOdometry;
}

std::optional<Reading> RawlogSource::next() {
  while (ready_.empty()) {
    const auto object = reader_.next();
    if (!object) {
      if (waiting_.empty()) return std::nullopt;
      // No odometry reading came after these: the last one holds.
      for (const auto& scan : waiting_) finish(scan, travelled_);
      waiting_.clear();
      break;
    }
    take(object);
  }
  Reading reading = ready_.front();
  ready_.pop_front();
  return reading;
}

void RawlogSource::take(const mrpt::serialization::CSerializable::Ptr& object) {
  if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(object)) {
    takeOdometry(*odometry);
  } else if (const auto action = std::dynamic_pointer_cast<CActionCollection>(object)) {
    travelled_ = travelled_ + odometryIncrement(*action);
  } else if (std::dynamic_pointer_cast<CSensoryFrame>(object)) {
    bool taken = false;  // one scan of the label for each frame
    forEachScan(object, [&](const CObservation2DRangeScan::Ptr& scan) {
      if (taken || scan->sensorLabel != sensorLabel_ || scan->getScanSize() == 0) return;
      taken = true;
      finish(scan, travelled_);
    });
  } else if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) {
    if (scan->sensorLabel == sensorLabel_ && scan->getScanSize() > 0) takeScan(scan);
  }
}

void RawlogSource::takeScan(const CObservation2DRangeScan::Ptr& scan) {
  const bool isCertain = !options_.requireOdometry || !isStamped(*scan) ||
                         (lastOdometry_ && seconds(scan->timestamp) == lastOdometryTime_);
  if (isCertain && waiting_.empty())
    finish(scan, travelled_);
  else
    waiting_.push_back(scan);
}

void RawlogSource::takeOdometry(const CObservationOdometry& odometry) {
  const TPose2D pose = odometry.odometry.asTPose();
  const bool isStampedOdometry = odometry.timestamp != INVALID_TIMESTAMP;
  const double time = isStampedOdometry ? seconds(odometry.timestamp) : lastOdometryTime_;
  for (const auto& scan : waiting_) {
    const double t = isStamped(*scan) ? seconds(scan->timestamp) : lastOdometryTime_;
    if (!lastOdometry_)
      finish(scan, pose);
    else if (lastOdometryTime_ < t && t <= time && time - lastOdometryTime_ <= options_.maxOdometryGap)
      finish(scan, interpolate(*lastOdometry_, pose, (t - lastOdometryTime_) / (time - lastOdometryTime_)));
    else
      finish(scan, *lastOdometry_);
  }
  waiting_.clear();
  lastOdometry_ = travelled_ = pose;
  lastOdometryTime_ = time;
}

void RawlogSource::finish(const CObservation2DRangeScan::Ptr& scan, const TPose2D& odometry) {
  Reading reading;
  reading.scan = scan;
  if (isStamped(*scan)) lastTimestamp_ = seconds(scan->timestamp);
  reading.timestamp = lastTimestamp_;
  if (!first_) reading.motion = odometry - atLastScan_;
  first_ = false;
  atLastScan_ = odometry;
  ready_.push_back(reading);
}

}  // namespace hybrid_slam
