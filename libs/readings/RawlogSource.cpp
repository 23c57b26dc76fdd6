#include "readings/RawlogSource.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "base/Degree.h"
#include "base/Errors.h"
#include "files/InputFile.h"
#include "files/RawlogReader.h"
#include "readings/BagPlan.h"
#include "readings/Timestamps.h"

namespace hybrid_slam::readings {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;

namespace {

void note(Oddity& oddity, size_t entry) {
  if (oddity.count++ == 0) oddity.first = entry;
}

std::string placeOf(const LogReader& reader, const std::string& file) {
  return reader.unit() + (" " + std::to_string(reader.entry())) + " of " + file;
}

constexpr double kAllAround = 340 * kDegree;  // aperture

using Uses = std::map<std::string, std::map<ScanGrouper::Use, size_t>>;  ///< scans of each laser, by use

std::string quotedList(const std::set<std::string>& labels) {
  std::string all;
  for (const std::string& label : labels) all += (all.empty() ? "`" : ", `") + label + "`";
  return all.empty() ? "none" : all;
}

std::set<std::string> labelsOf(const Uses& lasers) {
  std::set<std::string> labels;
  for (const auto& laser : lasers) labels.insert(laser.first);
  return labels;
}

/// Notes the lasers of which no scan is used.
void noteIgnored(RawlogSummary& summary, const Uses& lasers) {
  using Use = ScanGrouper::Use;
  for (const auto& [label, uses] : lasers) {
    if (uses.count(Use::taken) > 0) continue;
    Use why = Use::empty;
    for (const Use use : {Use::second, Use::tooMany, Use::misplaced, Use::tilted, Use::unwanted})
      if (uses.count(use) > 0) why = use;
    summary.ignored.push_back("laser `" + label + "` is not used: " + reasonOf(why));
  }
}

}  // namespace

void InputOptions::describe(OptionTable& t) {
  t.add("sensor_label", sensorLabel,
        "label of the laser to use (bag: topic), or a list `FRONT, REAR`; empty: all that are mounted "
        "horizontally (within 5 deg), at most " +
            std::to_string(kMaxLasers));
  t.add("laser_pose", laserPose,
        "X, Y, YAW[, ROLL] (m, deg): pose of the only laser on the robot, instead of that in the log; "
        "ROLL 180: mounted upside down; auto: as the log states");
  t.add("min_range", minRange, 0, 10, "m",
        "smallest range used, of all lasers; shorter ones may be of the robot's own parts");
  t.add("odometry_topic", odometryTopic,
        "sensor label of the odometry to use; empty: that of the first reading (bag: topic; empty: the only "
        "one, or the transforms)");
  t.add("require_odometry", requireOdometry,
        "false: odometry is ignored; motion is predicted from the previous step and corrected by scan "
        "matching");
  t.add(
      "heading_odometry", headingOdometry,
      "true: only the heading of the odometry is used, such as that of a gyroscope; scan matching gives the "
      "position");
  t.add("replace_stuck_odometry", replaceStuckOdometry,
        "where the odometry stands still while the scans move, as after a lost connection to the robot's "
        "base: scan matching gives the motion, until the odometry agrees with it again");
  t.add("max_odometry_gap", maxOdometryGap, 0, 1000, "s",
        "largest gap between odometry readings for interpolation at a scan's time");
  t.add("odometry_time_offset", odometryTimeOffset, -10, 10, "s",
        "added to the timestamps of odometry readings: their clock may differ from that of the scans");
  t.add("scan_time", scanTime, "auto", 0, kLongestSweep, "s",
        "time from the first beam of a scan to the last, for the correction by the robot's motion; auto: as "
        "the log states; 0: no correction");
  t.add("scan_rate", scanRate, "auto", kLowestRate, kHighestRate, "Hz",
        "turns of the lasers per second, instead of scan_time: a scan over A deg takes A / 360 / scan_rate "
        "seconds; auto: as scan_time says");
}

void InputOptions::check() const {
  if (scanTime && scanRate)
    throw InputError("both scan_time and scan_rate are set", "section [input], keys `scan_time`, `scan_rate`",
                     "expected one of them, and `auto` for the other");
  laserPoseIn(laserPose);
}

SensorSettings sensorSettings(const InputOptions& options, bool hasOdometry) {
  return {hasOdometry && options.requireOdometry ? SweepTimes(options.sweep()) : SweepTimes(0),
          laserPoseIn(options.laserPose), options.minRange, options.odometryTimeOffset};
}

OdometrySource odometrySource(const InputOptions& options, bool hasReadings) {
  if (!options.requireOdometry) return OdometrySource::none;
  return hasReadings ? OdometrySource::readings : OdometrySource::actions;
}

void RawlogSummary::adapt(const std::string& file, const InputOptions& options) {
  if (options.requireOdometry && (!hasOdometryReadings || options.odometryTimeOffset == 0)) return;
  scans += early.count;
  early.count = 0;
  isDeskewed = isDeskewed && options.requireOdometry;
  if (!options.requireOdometry) return;
  RawlogSource source(file, options, *this);
  source.next();
  early.count = source.dropped();
  scans -= early.count;
}

RawlogSummary summarise(const std::string& file, const InputOptions& options,
                        const std::function<bool()>& isStopped) {
  RawlogSummary summary;
  summary.state = files::stateOf(file);
  const std::vector<std::string> wanted = labelsOf(options.sensorLabel);
  if (bags::isBag(file))
    summary.bag = std::make_shared<const BagPlan>(
        planOf(contentsOf(file, isStopped), {wanted, options.odometryTopic}, file));
  const std::string chosen = summary.bag ? "" : options.odometryTopic;  // sensor label of the odometry
  LogReader reader(file, summary.bag);
  summary.unit = reader.unit();
  SweepTimes sweeps(options.sweep());
  const auto laserPose = laserPoseIn(options.laserPose);
  ScanGrouper grouper(wanted, options.maxOdometryGap, laserPose.has_value());
  ReadingAssembler beginning(wanted, OdometrySource::readings, options.maxOdometryGap,
                             {SweepTimes(0), laserPose, 0, options.odometryTimeOffset},
                             chosen);  // to its first reading
  bool hasBegun = false;
  size_t firstScan = 0;
  Uses uses;
  std::map<std::string, double> last;  // timestamp of each laser's previous scan
  Duration allLasers;
  std::map<std::string, Duration> durations;  // of each laser; their clocks may differ
  Oddity wrongActions, actionJumps;
  const auto noteOdometry = [&](bool isRight, bool& hasSome, Oddity& wrong) {
    if (isRight)
      hasSome = true;
    else
      note(wrong, reader.entry());
  };
  std::optional<TPose2D> first;
  std::set<std::string> odometryLabels;
  bool actionsMove = false, readingsMove = false, actionsTurn = false, readingsTurn = false;
  OdometryJumps jumps;
  const auto noteReading = [&](const CObservationOdometry& odometry) {
    const TPose2D pose = odometry.odometry.asTPose();
    noteOdometry(isPossible(pose), summary.hasOdometryReadings, summary.wrongOdometry);
    if (!isPossible(pose)) return;
    if (odometryLabels.empty()) summary.odometryLabel = chosen.empty() ? odometry.sensorLabel : chosen;
    if (odometryLabels.size() < kMostLabels) odometryLabels.insert(odometry.sensorLabel);
    if (odometry.sensorLabel != summary.odometryLabel) return note(summary.otherOdometry, reader.entry());
    if (!first) first = pose;
    if (jumps.isJump(pose, timeOf(odometry))) note(summary.jumps, reader.entry());
    readingsMove |= pose.x != first->x || pose.y != first->y;
    readingsTurn |= pose.phi != first->phi;
  };
  const auto noteScan = [&](const CObservation2DRangeScan& scan) {
    const ScanGrouper::Use use = grouper.useOf(scan);
    if (use == ScanGrouper::Use::taken || uses.size() < kMostLabels || uses.count(scan.sensorLabel) > 0)
      ++uses[scan.sensorLabel][use];
    if (use == ScanGrouper::Use::empty) return note(summary.empty, reader.entry());
    if (use == ScanGrouper::Use::misplaced) return note(summary.misplaced, reader.entry());
    if (use == ScanGrouper::Use::tilted) return note(summary.tilted, reader.entry());
    if (use != ScanGrouper::Use::taken) return;
    if (firstScan == 0) firstScan = reader.entry();
    summary.beams += scan.getScanSize();
    for (size_t i = 0; i < scan.getScanSize(); ++i) summary.returns += isReturn(scan, i);
    grouper.add(scan);
    summary.mountings.try_emplace(scan.sensorLabel, laserPose.value_or(scan.sensorPose));
    if (const double sweep = sweeps.of(scan); sweep > 0)
      summary.sweeps[scan.sensorLabel] = sweep;
    else if (scan.aperture > kAllAround && !options.sweep().seconds && !options.sweep().rate)
      summary.spinning.insert(scan.sensorLabel);
    if (!isStamped(scan)) return note(summary.unstamped, reader.entry());
    const double t = seconds(scan.timestamp);
    const auto [before, isNew] = last.try_emplace(scan.sensorLabel, t);
    if (!isNew && t < before->second) note(summary.stepsBack, reader.entry());
    if (!isNew && t - before->second > kDay) note(summary.timeJumps, reader.entry());
    if (!isNew && t == before->second) note(summary.repeatedStamps, reader.entry());
    allLasers.add(t);
    durations[scan.sensorLabel].add(t);
    before->second = t;
  };
  while (const auto object = reader.next()) {
    if (isStopped()) throw std::runtime_error("interrupted: " + placeOf(reader, file));
    if (const auto increment = incrementOf(object)) {
      noteOdometry(isFinite(*increment), summary.hasActions, wrongActions);
      actionsMove |= isFinite(*increment) && (increment->x != 0 || increment->y != 0);
      actionsTurn |= isFinite(*increment) && increment->phi != 0;
      if (isFinite(*increment) && isJump({}, *increment)) note(actionJumps, reader.entry());
    } else if (isAction(object)) {
      note(summary.noOdometry, reader.entry());
    }
    forEachObservation(object, [&](const CObservation::Ptr& observation) {
      if (const auto sweep = sweepTimeIn(*observation)) {
        sweeps.take(*sweep);
        if (!isSweepTime(sweep->seconds)) note(summary.wrongSweeps, reader.entry());
      }
      if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation))
        if (grouper.useOf(*scan) == ScanGrouper::Use::taken) grouper.expect(scan->sensorLabel);
    });
    forEachObservation(object, [&](const CObservation::Ptr& observation) {
      if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation))
        noteReading(*odometry);
      if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) noteScan(*scan);
    });
    if (!hasBegun) beginning.take(object);
    hasBegun = hasBegun || beginning.next();
  }
  summary.hasMotion = summary.hasOdometryReadings ? readingsMove : actionsMove;  // readings replace actions
  summary.hasTurns = summary.hasOdometryReadings ? readingsTurn : actionsTurn;
  if (!summary.hasOdometryReadings) {
    summary.jumps = actionJumps;
    if (wrongActions.count > 0) summary.wrongOdometry = wrongActions;
  }
  summary.duration = allLasers.seconds();
  for (const auto& [label, duration] : durations)
    summary.duration = std::max(summary.duration, duration.seconds());
  summary.entries = reader.entry();
  summary.defect = reader.defect();
  summary.brokenLines = {reader.brokenLines(), reader.firstBroken()};
  if (const files::RawlogReader* const rawlog = reader.rawlog()) {
    summary.passedOver = {rawlog->passedOver(), rawlog->firstPassedOver()};
    for (const std::string& name : rawlog->passedOverClasses())
      summary.passedOverClasses += (summary.passedOverClasses.empty() ? "" : ", ") + name;
  }
  summary.scans = grouper.readings();
  summary.lasers.assign(grouper.lasers().begin(), grouper.lasers().end());
  summary.ignored = reader.ignoredLasers();
  noteIgnored(summary, uses);
  for (const auto& sweep : summary.sweeps) summary.spinning.erase(sweep.first);
  summary.isDeskewed = options.requireOdometry && (summary.hasMotion || summary.hasTurns) &&
                       (summary.hasActions || summary.hasOdometryReadings);

  if (uses.empty())
    throw InputError("no laser scans", file, "expected objects of class CObservation2DRangeScan");
  for (const std::string& label : wanted)
    if (uses.count(label) == 0)
      throw InputError("no scans of the laser `" + label + "`", file,
                       "[input] sensor_label: the log has " + quotedList(labelsOf(uses)));
  if (!chosen.empty() && odometryLabels.count(chosen) == 0)
    throw InputError("no odometry readings of the sensor `" + chosen + "`", file,
                     "--odometry-topic or [input] odometry_topic: the log has " + quotedList(odometryLabels));
  if (summary.scans == 0 && summary.misplaced.count > 0)
    throw InputError("the laser is not on the robot", "sensor `" + uses.begin()->first + "` in " + file,
                     "expected a sensor pose within 100 m of the robot");
  if (summary.scans == 0 && summary.tilted.count > 0)
    throw InputError("the laser's scan plane is tilted", "sensor `" + uses.begin()->first + "` in " + file,
                     "expected a horizontal plane within 5 deg, upright or upside down");
  if (summary.scans == 0)
    throw InputError("all scans are of zero length", file, "expected scans with at least one beam");
  summary.early.first = firstScan;
  if (summary.hasOdometryReadings && options.requireOdometry) {
    summary.early.count = beginning.dropped();
    summary.scans -= beginning.dropped();
  }
  return summary;
}

RawlogSource::RawlogSource(const std::string& file, const InputOptions& options, const RawlogSummary& summary)
    : assembler_(labelsOf(options.sensorLabel), odometrySource(options, summary.hasOdometryReadings),
                 options.maxOdometryGap,
                 sensorSettings(options, summary.hasActions || summary.hasOdometryReadings),
                 summary.odometryLabel),
      file_(file),
      reader_(file, summary.bag) {}

std::string RawlogSource::place() const { return placeOf(reader_, file_); }

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
  return reading;
}

}  // namespace hybrid_slam::readings
