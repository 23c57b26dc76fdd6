#include "readings/RawlogSource.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "base/Errors.h"

namespace hybrid_slam::readings {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;

namespace {

void note(Oddity& oddity, size_t entry) {
  if (oddity.count++ == 0) oddity.first = entry;
}

bool isStamped(const CObservation2DRangeScan& scan) { return scan.timestamp != INVALID_TIMESTAMP; }
double seconds(const mrpt::Clock::time_point& t) { return mrpt::Clock::toDouble(t); }

}  // namespace

void InputOptions::describe(OptionTable& t) {
  t.add("sensor_label", sensorLabel, "label of the laser to use; empty: that of the first scan in the log");
  t.add("require_odometry", requireOdometry,
        "false: take a log of scans only, as if the odometry said that the robot stands still");
  t.add("max_odometry_gap", maxOdometryGap, 0, 1000, "s",
        "odometry is interpolated at a scan's time between readings no farther apart than this");
}

RawlogSummary summarise(const std::string& file, const InputOptions& options,
                        const std::function<bool()>& isStopped) {
  RawlogSummary summary;
  summary.sensorLabel = options.sensorLabel;
  files::RawlogReader reader(file);
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
    if (isStopped())
      throw std::runtime_error("interrupted: entry " + std::to_string(reader.entry()) + " of " + file);
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
      assembler_(summary.sensorLabel, summary.hasOdometryReadings, options.maxOdometryGap) {}

std::optional<Reading> RawlogSource::next() {
  auto reading = assembler_.next();
  while (!reading && !isAtEnd_) {
    if (const auto object = reader_.next()) {
      assembler_.take(object);
    } else {
      assembler_.finish();
      isAtEnd_ = true;
    }
    reading = assembler_.next();
  }
  if (reading && reading->motion.norm() > kMaxStep)
    throw InputError("odometry jumps", "entry " + std::to_string(reader_.entry()) + " of " + file_,
                     "expected at most 100 m between two scans");
  return reading;
}

}  // namespace hybrid_slam::readings
