/// @file TinyslamLog.cpp
/// @brief tinySLAM's logs (CoreSLAM, Mines ParisTech): one row of numbers for each scan of its robot.
#include <algorithm>
#include <cmath>

#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {
namespace {

constexpr size_t kFieldsBeforeRanges = 24;
constexpr size_t kBeams = 682;     // of a Hokuyo URG-04LX, in mm; a field of no meaning follows
constexpr double kLaserX = 0.145;  // m
constexpr double kTick = 2 * M_PI * 0.077 / 2000;  // m, of a wheel of 0.077 m
constexpr double kAxle = 0.33;                     // m, between the wheels

class TinyslamParser : public LogParser {
 public:
  using LogParser::LogParser;

 private:
  LogRecord record(std::string_view name, LogFields& fields) override;
  /// Moves the pose by the turns of the wheels since the row before (ticks).
  void move(double left, double right);

  mrpt::math::TPose2D pose_;
  std::optional<double> left_, right_;
};

/// `microseconds _ left right`, 20 fields that are not used, ranges.
LogRecord TinyslamParser::record(std::string_view name, LogFields& fields) {
  fields.expectLeft(kFieldsBeforeRanges + kBeams, "those of a row of tinySLAM");
  LogFields first(name);
  fields.skip(1);
  const double left = fields.number(), right = fields.number();
  fields.skip(kFieldsBeforeRanges - 4);
  LaserRecord scan = LogParser::scan("LASER", kBeams, fields);
  for (float& range : scan.ranges) range /= 1000;
  scan.time = first.number() / 1e6;
  if (scan.time < 0 || scan.time > 1e11) throw BrokenLine(inBackquotes(name) + " is not a time");
  scan.laserPose = {options_.laserX.value_or(kLaserX), 0, 0};
  move(left, right);
  scan.odometry = pose_;
  return scan;
}

void TinyslamParser::move(double left, double right) {
  const double l = kTick * (left - left_.value_or(left)), r = kTick * (right - right_.value_or(right));
  const double turn = (r - l) / kAxle, heading = pose_.phi + turn / 2;
  pose_.x += (l + r) / 2 * std::cos(heading);
  pose_.y += (l + r) / 2 * std::sin(heading);
  pose_.phi = std::remainder(pose_.phi + turn, 2 * M_PI);
  left_ = left;
  right_ = right;
}

bool isTinyslam(std::string_view name, size_t fields) {
  return fields == kFieldsBeforeRanges + kBeams &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

/// The laser measures up to 4.095 m, and says up to 5.6 m.
const LogFormat kTinyslamLog{"tinyslam", "tinySLAM", "numbers", 5.6, isTinyslam, makeParser<TinyslamParser>};

}  // namespace hybrid_slam::readings
