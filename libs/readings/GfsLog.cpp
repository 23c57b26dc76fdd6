/// @file GfsLog.cpp
/// @brief Logs of GMapping: rows `ODOM` and `LASER_READING`.
#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {
namespace {

class GfsParser : public LogParser {
 public:
  using LogParser::LogParser;

 private:
  LogRecord record(std::string_view name, LogFields& fields) override;
  LogRecord odometry(LogFields& fields);

  std::optional<double> lastOdometryTime_, lastScanTime_;
};

LogRecord GfsParser::record(std::string_view name, LogFields& fields) {
  if (name == "ODOM") return odometry(fields);
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
LogRecord GfsParser::odometry(LogFields& fields) {
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

bool isGfs(std::string_view name, size_t fields) {
  return (name == "ODOM" && fields == 4) ||  // x y theta time
         name == "LASER_READING" || name == "ODO_UPDATE" || name == "SM_UPDATE" || name == "FRAME";
}

}  // namespace

const LogFormat kGfsLog{"gfs", "GMapping .gfs", "LASER_READING", ".gfs", 80, isGfs, makeParser<GfsParser>};

}  // namespace hybrid_slam::readings
