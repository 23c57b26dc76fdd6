/// @file CarmenLog.cpp
/// @brief Logs of CARMEN's logger: rows `ODOM`, `PARAM` and those of the lasers.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "readings/LaserMounting.h"
#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {
namespace {

/// Kinds of a laser's rows, the most useful first. A log may hold the same scan in rows of two kinds.
enum class Rows {
  posed,     ///< with the robot's pose: FLASER, RLASER, ROBOTLASERn
  mounted,   ///< LASERn and RAWLASERn of the front (1) and the rear laser (2)
  unmounted  ///< LASERn and RAWLASERn of others, whose place on the robot the log does not state
};

/// Returns 3 for `LASER3`; 0 for another name.
int laserNumber(std::string_view name, std::string_view kind) {
  const bool isKind = name.size() == kind.size() + 1 && name.substr(0, kind.size()) == kind;
  return isKind && name.back() >= '1' && name.back() <= '9' ? name.back() - '0' : 0;
}

std::optional<Rows> rowsOf(std::string_view name) {
  if (name == "FLASER" || name == "RLASER" || laserNumber(name, "ROBOTLASER") > 0) return Rows::posed;
  const int number = std::max(laserNumber(name, "LASER"), laserNumber(name, "RAWLASER"));
  if (number == 0) return std::nullopt;
  return number <= 2 ? Rows::mounted : Rows::unmounted;
}

/// Returns the number of the laser of these rows. CARMEN's front laser is 1, its rear one 2, in all rows.
int numberOf(std::string_view rows) {
  return rows == "FLASER" ? 1 : rows == "RLASER" ? 2 : rows.back() - '0';
}

class CarmenParser : public LogParser {
 public:
  using LogParser::LogParser;
  void preview(std::string_view line) override;
  std::vector<std::string> ignoredLasers() const override;

 private:
  LogRecord record(std::string_view name, LogFields& fields) override;
  LogRecord laser(std::string_view name, LogFields& fields);
  LogRecord plainLaser(std::string_view name, LogFields& fields) const;
  LogRecord rawLaser(std::string_view name, LogFields& fields) const;
  LogRecord robotLaser(std::string_view name, LogFields& fields);
  /// Reads the laser's configuration and ranges, up to its remissions.
  static LaserRecord configuredScan(std::string_view name, LogFields& fields);
  /// Returns the pose of the laser with this number.
  mrpt::math::TPose2D mounting(int number) const;
  /// Returns the pose of the rear laser; `PARAM` has the x where the rows have none.
  mrpt::math::TPose2D rearMounting(const mrpt::math::TPose2D& laser, const mrpt::math::TPose2D& robot);
  void previewMounting(std::string_view name, std::string_view line);
  void parameter(LogFields& fields);
  double time(LogFields& fields) const;

  Rows used_ = Rows::unmounted;              ///< rows of later kinds are skipped
  bool odometryMoves_ = false;               ///< an `ODOM` row among the first ones is not zero
  size_t zeroRows_ = 0, movedRows_ = 0;      ///< first rows of lasers, by the robot's pose in them
  std::set<int> usedLasers_;                 ///< numbers
  std::set<std::string> skippedRows_;        ///< names
  double frontOffset_ = 0, rearOffset_ = 0;  ///< m, x of the lasers on the robot, by `PARAM`
  std::map<std::string, LaserMounting, std::less<>> mountings_;  ///< by the name of the rows
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
  const auto rows = rowsOf(name);
  if (rows && *rows > used_) {
    skippedRows_.emplace(name);
    return otherRecord(name);
  }
  if (rows) usedLasers_.insert(numberOf(name));
  if (name == "FLASER" || name == "RLASER") return laser(name, fields);
  if (rows == Rows::posed) return robotLaser(name, fields);
  if (rows) return laserNumber(name, "LASER") > 0 ? plainLaser(name, fields) : rawLaser(name, fields);
  if (name == "PARAM") {
    parameter(fields);
    return {};
  }
  return otherRecord(name);
}

void CarmenParser::preview(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::string_view name = line.substr(0, line.find_first_of(" \t"));
  if (name == "ODOM" && !odometryMoves_) {
    LogFields fields(line.substr(name.size()));
    odometryMoves_ = fields.left() == 9 && !fields.isZero(0, 3);
  }
  const auto rows = rowsOf(name);
  if (!rows) return;
  used_ = std::min(used_, *rows);
  if (rows == Rows::posed) previewMounting(name, line);
}

void CarmenParser::previewMounting(std::string_view name, std::string_view line) try {
  LaserMounting& mounting = mountings_.try_emplace(std::string(name)).first->second;
  if (mounting.isPreviewed()) return;
  LogFields fields(line.substr(name.size()));
  if (name == "FLASER" || name == "RLASER") {
    const size_t beams = fields.count(1);
    if (fields.left() != beams + 9) return;
    fields.skip(beams);
  } else {
    configuredScan(name, fields);
    fields.skip(fields.count(0));
    if (fields.left() != 14) return;
  }
  const mrpt::math::TPose2D laser = fields.pose(), robot = fields.pose();
  mounting.preview(laser, robot);
  (robot == mrpt::math::TPose2D() ? zeroRows_ : movedRows_) += 1;
} catch (const BrokenLine&) {
  // Reading the log will report it.
}

std::vector<std::string> CarmenParser::ignoredLasers() const {
  std::vector<std::string> all;
  for (const std::string& name : skippedRows_)
    if (usedLasers_.count(numberOf(name)) == 0)
      all.push_back("laser `" + name + "` is not used: " +
                    (rowsOf(name) == Rows::mounted
                         ? "its rows lack the robot's pose, unlike those of other lasers"
                         : "the log does not state its pose on the robot"));
  return all;
}

mrpt::math::TPose2D CarmenParser::mounting(int number) const {
  if (number == 1) return {options_.laserX.value_or(frontOffset_), 0, 0};
  if (number == 2) return {rearOffset_, 0, M_PI};
  return {};
}

LogRecord CarmenParser::laser(std::string_view name, LogFields& fields) {
  const size_t beams = fields.count(1);
  const bool hasRobot = fields.left() != beams + 8 || !fields.isZero(beams + 3, 3);
  if (hasRobot)
    fields.expectLeft(beams + 9, std::to_string(beams) +
                                     " ranges, the laser's and the robot's pose, "
                                     "ipc_time host logger_time");
  LaserRecord record = scan(name, beams, fields);
  record.laserPose = mounting(numberOf(name));
  if (!hasRobot) {
    // The log of Orebro has the odometry in place of the laser's pose.
    record.odometry = fields.pose();
    fields.skip(4);  // zeros, host
    record.time = fields.time();
    return record;
  }
  const mrpt::math::TPose2D laser = fields.pose();
  record.odometry = fields.pose();
  record.time = time(fields);
  constexpr size_t kFewest = 10;
  if (odometryMoves_ && movedRows_ == 0 && zeroRows_ >= kFewest) {  // zeros in place of both poses
    record.odometry.reset();
    return record;
  }
  if (name == "RLASER")
    record.laserPose = rearMounting(laser, *record.odometry);
  else if (!options_.laserX)
    record.laserPose = mountings_["FLASER"].of(laser, *record.odometry).value_or(record.laserPose);
  return record;
}

mrpt::math::TPose2D CarmenParser::rearMounting(const mrpt::math::TPose2D& laser,
                                               const mrpt::math::TPose2D& robot) {
  constexpr double kLeast = 0.02;  // m: rows with the robot's pose twice do not state the mounting
  LaserMounting& rows = mountings_["RLASER"];
  if (rows.agreement() != LaserMounting::Agreement::agreed) return mounting(2);
  const auto pose = rows.of(laser, robot);
  if (pose->norm() < kLeast) return mounting(2);
  return {pose->x, pose->y, M_PI};  // logs differ in whether the heading in the row includes the half turn
}

LogRecord CarmenParser::plainLaser(std::string_view name, LogFields& fields) const {
  const size_t beams = fields.count(1);
  fields.expectLeft(beams + 3, std::to_string(beams) + " ranges, ipc_time host logger_time");
  LaserRecord record = scan(name, beams, fields);
  record.time = time(fields);
  record.laserPose = mounting(laserNumber(name, "LASER"));
  return record;
}

LogRecord CarmenParser::rawLaser(std::string_view name, LogFields& fields) const {
  LaserRecord record = configuredScan(name, fields);
  const size_t remissions = fields.count(0);
  fields.expectLeft(remissions + 3, std::to_string(remissions) + " remissions, ipc_time host logger_time");
  fields.skip(remissions);
  record.time = time(fields);
  record.laserPose = mounting(laserNumber(name, "RAWLASER"));
  return record;
}

LaserRecord CarmenParser::configuredScan(std::string_view name, LogFields& fields) {
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
  return record;
}

LogRecord CarmenParser::robotLaser(std::string_view name, LogFields& fields) {
  LaserRecord record = configuredScan(name, fields);
  const size_t remissions = fields.count(0);
  fields.expectLeft(remissions + 14, std::to_string(remissions) +
                                         " remissions, the laser's and the robot's pose, tv rv, three safety "
                                         "distances, ipc_time host logger_time");
  fields.skip(remissions);
  const mrpt::math::TPose2D sensor = fields.pose();
  record.odometry = fields.pose();
  LaserMounting& rows = mountings_.try_emplace(std::string(name)).first->second;
  record.laserPose = rows.agreement() == LaserMounting::Agreement::unknown  // it may pan
                         ? sensor - *record.odometry
                         : rows.of(sensor, *record.odometry).value_or(mounting(numberOf(name)));
  for (int i = 0; i < 5; ++i) fields.number();  // velocities and safety distances
  record.time = time(fields);
  return record;
}

void CarmenParser::parameter(LogFields& fields) {
  const std::string_view key = fields.word();
  if (key == "robot_frontlaser_offset") frontOffset_ = fields.number();
  if (key == "robot_rearlaser_offset") rearOffset_ = fields.number();
}

/// Reads the last fields of every CARMEN row.
double CarmenParser::time(LogFields& fields) const {
  const double ipc = fields.time();
  fields.word();  // host
  const double logger = fields.time();
  return options_.time == LogTime::ipc ? ipc : logger;
}

bool isCarmen(std::string_view name, size_t fields) {
  // x y theta tv rv acceleration ipc_time host logger_time
  return (name == "ODOM" && fields == 9) || rowsOf(name) || name == "PARAM";
}

}  // namespace

const LogFormat kCarmenLog{"carmen",
                           "CARMEN",
                           "FLASER, RLASER, LASER1-9, RAWLASER1-9, ROBOTLASER1-9",
                           ".clf .log",
                           80,
                           isCarmen,
                           makeParser<CarmenParser>};

}  // namespace hybrid_slam::readings
