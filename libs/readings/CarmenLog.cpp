/// @file CarmenLog.cpp
/// @brief CARMEN's logger: rows `ODOM`, `FLASER`, `RLASER`, `ROBOTLASER1`, `PARAM`.
#include <cmath>

#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {
namespace {

class CarmenParser : public LogParser {
 public:
  using LogParser::LogParser;

 private:
  LogRecord record(std::string_view name, LogFields& fields) override;
  LogRecord laser(std::string_view name, LogFields& fields) const;
  LogRecord robotLaser(std::string_view name, LogFields& fields) const;
  void parameter(LogFields& fields);
  double time(LogFields& fields) const;

  double frontOffset_ = 0, rearOffset_ = 0;  ///< m, of the lasers ahead of the robot's centre
};

LogRecord CarmenParser::record(std::string_view name, LogFields& fields) {
  if (name == "ODOM") {
    fields.expectLeft(9, "x y theta tv rv acceleration ipc_time host logger_time");
    OdometryRecord row;
    row.pose = fields.pose();
    for (int i = 0; i < 3; ++i) fields.number();  // tv, rv, acceleration
    row.time = time(fields);
    return row;
  }
  if (name == "FLASER" || name == "RLASER") return laser(name, fields);
  if (name == "ROBOTLASER1") return robotLaser(name, fields);
  if (name == "PARAM") {
    parameter(fields);
    return {};
  }
  return otherRecord(name);
}

LogRecord CarmenParser::laser(std::string_view name, LogFields& fields) const {
  const size_t beams = fields.count(1);
  fields.expectLeft(beams + 9, std::to_string(beams) +
                                   " ranges, the laser's and the robot's pose, "
                                   "ipc_time host logger_time");
  LaserRecord record = scan(name, beams, fields);
  // Ignore the laser pose: in corrected logs it is a mapper's result, not the mounting.
  fields.pose();
  record.odometry = fields.pose();
  record.time = time(fields);
  if (name == "RLASER")
    record.laserPose = {rearOffset_, 0, M_PI};
  else
    record.laserPose = {options_.laserX.value_or(frontOffset_), 0, 0};
  return record;
}

LogRecord CarmenParser::robotLaser(std::string_view name, LogFields& fields) const {
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
  const mrpt::math::TPose2D sensor = fields.pose();
  record.odometry = fields.pose();
  record.laserPose = sensor - *record.odometry;
  for (int i = 0; i < 5; ++i) fields.number();  // velocities and safety distances
  record.time = time(fields);
  return record;
}

void CarmenParser::parameter(LogFields& fields) {
  const std::string_view key = fields.word();
  if (key == "robot_frontlaser_offset") frontOffset_ = fields.number();
  if (key == "robot_rearlaser_offset") rearOffset_ = fields.number();
}

/// The last fields of every CARMEN row.
double CarmenParser::time(LogFields& fields) const {
  const double ipc = fields.time();
  fields.word();  // host
  const double logger = fields.time();
  return options_.time == LogTime::ipc ? ipc : logger;
}

bool isCarmen(std::string_view name, size_t fields) {
  // x y theta tv rv acceleration ipc_time host logger_time
  return (name == "ODOM" && fields == 9) || name == "FLASER" || name == "RLASER" || name == "ROBOTLASER1" ||
         name == "PARAM";
}

}  // namespace

const LogFormat kCarmenLog{"carmen", "CARMEN", "FLASER, RLASER, ROBOTLASER1",
                           80,       isCarmen, makeParser<CarmenParser>};

}  // namespace hybrid_slam::readings
