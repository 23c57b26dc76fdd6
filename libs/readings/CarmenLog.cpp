/// @file CarmenLog.cpp
/// @brief CARMEN's logger: rows `ODOM`, `FLASER`, `RLASER`, `ROBOTLASER1`, `PARAM`.
#include <cmath>
#include <optional>

#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {
namespace {

/// The front laser's pose on the robot, from the two poses of its rows. CARMEN writes the mounting that was
/// in force into every row, so rows that agree are believed rather than `PARAM`, which may be of another
/// robot. A corrected log has a mapper's pose in place of the laser's: its rows soon disagree.
class FrontLaserMounting {
 public:
  /// Null once the rows have disagreed.
  std::optional<mrpt::math::TPose2D> of(const mrpt::math::TPose2D& laser, const mrpt::math::TPose2D& robot) {
    const mrpt::math::TPose2D mounting = laser - robot;
    if (!first_) first_ = mounting;
    const mrpt::math::TPose2D change = mounting - *first_;
    constexpr double kFarthest = 2, kDistance = 0.005, kAngle = 0.005;  // m, m, rad
    if (mounting.norm() > kFarthest || change.norm() > kDistance || std::abs(change.phi) > kAngle)
      agree_ = false;
    return agree_ ? first_ : std::nullopt;
  }

 private:
  std::optional<mrpt::math::TPose2D> first_;
  bool agree_ = true;
};

class CarmenParser : public LogParser {
 public:
  using LogParser::LogParser;

 private:
  LogRecord record(std::string_view name, LogFields& fields) override;
  LogRecord laser(std::string_view name, LogFields& fields);
  LogRecord robotLaser(std::string_view name, LogFields& fields) const;
  void parameter(LogFields& fields);
  double time(LogFields& fields) const;

  double frontOffset_ = 0, rearOffset_ = 0;  ///< m, of the lasers ahead of the robot's centre, by `PARAM`
  FrontLaserMounting frontMounting_;
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

LogRecord CarmenParser::laser(std::string_view name, LogFields& fields) {
  const size_t beams = fields.count(1);
  fields.expectLeft(beams + 9, std::to_string(beams) +
                                   " ranges, the laser's and the robot's pose, "
                                   "ipc_time host logger_time");
  LaserRecord record = scan(name, beams, fields);
  const mrpt::math::TPose2D laser = fields.pose();
  record.odometry = fields.pose();
  record.time = time(fields);
  if (name == "RLASER")
    record.laserPose = {rearOffset_, 0,
                        M_PI};  // logs differ in whether the row's heading includes the half turn
  else if (options_.laserX)
    record.laserPose = {*options_.laserX, 0, 0};
  else
    record.laserPose =
        frontMounting_.of(laser, *record.odometry).value_or(mrpt::math::TPose2D(frontOffset_, 0, 0));
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
