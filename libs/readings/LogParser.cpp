#include "readings/LogParser.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "readings/LogFields.h"

namespace hybrid_slam::readings {
namespace {

bool sameWord(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Message names are in capitals: `SYNC`, `NMEA-GGA`, `SM_UPDATE`.
bool isRecordName(std::string_view word) {
  return word.size() <= 32 && word.front() >= 'A' && word.front() <= 'Z' &&
         std::all_of(word.begin(), word.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

LogRecord otherRecord(std::string_view name) {
  if (!isRecordName(name)) throw BrokenLine(inBackquotes(name) + " is not a record's name");
  return OtherRecord{std::string(name)};
}

std::vector<float> ranges(size_t beams, LogFields& fields) {
  std::vector<float> values(beams);
  for (float& value : values) value = fields.range();
  return values;
}

}  // namespace

std::optional<LogFormat> formatOf(std::string_view line) {
  LogFields fields(line);
  if (fields.empty()) return std::nullopt;
  const std::string_view name = fields.word();
  if (sameWord(name, "Odometry") || sameWord(name, "Laser")) return LogFormat::dpslam;
  if (name == "LASER_READING" || name == "ODO_UPDATE" || name == "SM_UPDATE" || name == "FRAME")
    return LogFormat::gfs;
  // x y theta time, or x y theta tv rv acceleration ipc_time host logger_time
  if (name == "ODOM" && fields.left() == 4) return LogFormat::gfs;
  if (name == "ODOM" && fields.left() == 9) return LogFormat::carmen;
  if (name == "FLASER" || name == "RLASER" || name == "ROBOTLASER1" || name == "PARAM")
    return LogFormat::carmen;
  return std::nullopt;
}

LogRecord LogParser::parse(std::string_view line) {
  LogFields fields(line);
  if (fields.empty()) return {};
  const std::string_view name = fields.word();
  if (name.front() == '#') return {};
  switch (format_) {
    case LogFormat::carmen:
      return carmen(name, fields);
    case LogFormat::gfs:
      return gfs(name, fields);
    case LogFormat::dpslam:
      return dpslam(name, fields);
  }
  return {};
}

LogRecord LogParser::carmen(std::string_view name, LogFields& fields) {
  if (name == "ODOM") {
    fields.expectLeft(9, "x y theta tv rv acceleration ipc_time host logger_time");
    OdometryRecord record;
    record.pose = fields.pose();
    for (int i = 0; i < 3; ++i) fields.number();  // tv, rv, acceleration
    record.time = carmenTime(fields);
    return record;
  }
  if (name == "FLASER" || name == "RLASER") return carmenLaser(name, fields);
  if (name == "ROBOTLASER1") return carmenRobotLaser(name, fields);
  if (name == "PARAM") {
    parameter(fields);
    return {};
  }
  return otherRecord(name);
}

LogRecord LogParser::carmenLaser(std::string_view name, LogFields& fields) const {
  const size_t beams = fields.count(1);
  fields.expectLeft(beams + 9, std::to_string(beams) +
                                   " ranges, the laser's and the robot's pose, "
                                   "ipc_time host logger_time");
  LaserRecord record = scan(name, beams, fields);
  // Ignore the laser pose: in corrected logs it is a mapper's result, not the mounting.
  fields.pose();
  record.odometry = fields.pose();
  record.time = carmenTime(fields);
  if (name == "RLASER")
    record.laserPose = {rearOffset_, 0, M_PI};
  else
    record.laserPose = {options_.laserX.value_or(frontOffset_), 0, 0};
  return record;
}

LogRecord LogParser::carmenRobotLaser(std::string_view name, LogFields& fields) const {
  LaserRecord record;
  record.label = name;
  fields.number();  // laser type
  record.angles.first = fields.number();
  fields.number();  // field of view: beams * resolution in some logs, one step less in others
  record.angles.step = fields.number();
  if (!(record.angles.step > 0)) throw BrokenLine("the angular resolution is not positive");
  record.maxRange = fields.number();
  if (!(*record.maxRange > 0)) record.maxRange.reset();
  for (int i = 0; i < 2; ++i) fields.number();  // accuracy, remission mode
  const size_t beams = fields.count(1);
  if (fields.left() <= beams) throw BrokenLine("truncated line: " + std::to_string(beams) + " ranges");
  record.ranges = ranges(beams, fields);
  const size_t remissions = fields.count(0);
  fields.expectLeft(remissions + 14, std::to_string(remissions) +
                                         " remissions, the laser's and the robot's pose, tv rv, three safety "
                                         "distances, ipc_time host logger_time");
  fields.skip(remissions);
  const mrpt::math::TPose2D laser = fields.pose();
  record.odometry = fields.pose();
  record.laserPose = laser - *record.odometry;
  for (int i = 0; i < 5; ++i) fields.number();  // velocities and safety distances
  record.time = carmenTime(fields);
  return record;
}

void LogParser::parameter(LogFields& fields) {
  const std::string_view key = fields.word();
  if (key == "robot_frontlaser_offset") frontOffset_ = fields.number();
  if (key == "robot_rearlaser_offset") rearOffset_ = fields.number();
}

/// The last fields of every CARMEN row.
double LogParser::carmenTime(LogFields& fields) const {
  const double ipc = fields.time();
  fields.word();  // host
  const double logger = fields.time();
  return options_.time == LogTime::ipc ? ipc : logger;
}

LogRecord LogParser::gfs(std::string_view name, LogFields& fields) {
  if (name == "ODOM") return gfsOdometry(fields);
  if (name == "LASER_READING") {
    const size_t beams = fields.count(1);
    fields.expectLeft(beams + 4, std::to_string(beams) + " ranges, x y theta time");
    LaserRecord record = scan(name, beams, fields);
    record.odometry = fields.pose();
    lastScanTime_ = record.time = fields.time();
    record.laserPose = {options_.laserX.value_or(0), 0, 0};
    return record;
  }
  return otherRecord(name);
}

/// GMapping writes a row before it takes over the new reading's pose: the pose belongs to the previous
/// reading, the time to the new one. This restores each pose's own time; if that reading's scan was logged,
/// its more precise pose was already output with it.
LogRecord LogParser::gfsOdometry(LogFields& fields) {
  fields.expectLeft(4, "x y theta time");
  OdometryRecord record;
  record.pose = fields.pose();
  const double rowTime = fields.time();
  const bool first = !lastOdometryTime_;
  record.time = lastOdometryTime_.value_or(rowTime);
  lastOdometryTime_ = rowTime;
  if (!first && lastScanTime_ == record.time) return {};
  return record;
}

LogRecord LogParser::dpslam(std::string_view name, LogFields& fields) {
  if (sameWord(name, "Odometry")) {
    fields.expectLeft(3, "x y theta");
    OdometryRecord record;
    record.pose = fields.pose();
    record.time = ++step_ * options_.period;
    stepHasScan_ = false;
    return record;
  }
  if (sameWord(name, "Laser")) {
    const size_t beams = fields.count(1);
    fields.expectLeft(beams, std::to_string(beams) + " ranges");
    LaserRecord record = scan("LASER", beams, fields);
    if (stepHasScan_) ++step_;
    stepHasScan_ = true;
    record.time = step_ * options_.period;
    record.laserPose = {options_.laserX.value_or(0), 0, 0};
    return record;
  }
  throw BrokenLine(inBackquotes(name) + " is neither Odometry nor Laser");
}

/// The ranges, with angles derived from their number.
LaserRecord LogParser::scan(std::string_view name, size_t beams, LogFields& fields) const {
  const std::optional<double> step = options_.angularStep ? options_.angularStep : angularStepFor(beams);
  if (!step)
    throw BrokenLine("no known laser has " + std::to_string(beams) +
                     " beams: the angular step must be given");
  LaserRecord record;
  record.label = name;
  record.angles = beamAngles(beams, *step);
  record.ranges = ranges(beams, fields);
  return record;
}

}  // namespace hybrid_slam::readings
