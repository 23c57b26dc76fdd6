/// @file DpslamLog.cpp
/// @brief Logs of DP-SLAM: rows `Odometry` and `Laser`, without times.
#include <algorithm>
#include <cctype>

#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {
namespace {

bool sameWord(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

class DpslamParser : public LogParser {
 public:
  using LogParser::LogParser;

 private:
  LogRecord record(std::string_view name, LogFields& fields) override;

  // A step is an odometry row and the scans after it, up to the second scan.
  int step_ = -1;
  bool stepHasScan_ = true;
};

LogRecord DpslamParser::record(std::string_view name, LogFields& fields) {
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

bool isDpslam(std::string_view name, size_t /*fields*/) {
  return sameWord(name, "Odometry") || sameWord(name, "Laser");
}

}  // namespace

const LogFormat kDpslamLog{"dpslam", "DP-SLAM", "Laser", ".log", 8.18, isDpslam, makeParser<DpslamParser>};

}  // namespace hybrid_slam::readings
