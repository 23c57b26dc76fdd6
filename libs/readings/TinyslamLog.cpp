/// @file TinyslamLog.cpp
/// @brief Logs of tinySLAM (CoreSLAM, Mines ParisTech): one row of numbers for each scan.
#include <algorithm>
#include <cmath>
#include <deque>

#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::readings {
namespace {

constexpr size_t kFieldsBeforeRanges = 24;
constexpr size_t kBeams = 682;     // of a Hokuyo URG-04LX, in mm; a field of no meaning follows
constexpr double kLaserX = 0.145;  // m
constexpr double kTick = 2 * M_PI * 0.077 / 2000;  // m, of a wheel of 0.077 m
constexpr double kAxle = 0.33;                     // m, between the wheels
/// s from a scan to the odometry of its row. In the two published logs, scan matching contradicts the
/// odometry least if that of 0.14 to 0.2 s before is used.
constexpr double kLag = 0.15;

struct Wheels {
  double time = 0;             ///< s
  double left = 0, right = 0;  ///< ticks
};

class TinyslamParser : public LogParser {
 public:
  using LogParser::LogParser;

 private:
  LogRecord record(std::string_view name, LogFields& fields) override;
  /// Returns the wheel positions at a time (s) no later than the newest row.
  Wheels wheelsAt(double time);
  /// Moves the pose by the turns of the wheels since the previous call.
  void move(const Wheels& wheels);

  mrpt::math::TPose2D pose_;
  std::optional<Wheels> moved_;
  std::deque<Wheels> rows_;  ///< of the last `kLag`, by increasing time
};

/// Parses `microseconds _ left right`, 20 unused fields, and the ranges.
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
  if (!rows_.empty() && scan.time <= rows_.back().time) rows_.clear();
  rows_.push_back({scan.time, left, right});
  move(wheelsAt(scan.time - kLag));
  scan.odometry = pose_;
  return scan;
}

Wheels TinyslamParser::wheelsAt(double time) {
  while (rows_.size() > 1 && rows_[1].time <= time) rows_.pop_front();
  const Wheels before = rows_.front();
  if (rows_.size() == 1 || time <= before.time) return before;
  const Wheels& after = rows_[1];
  const double share = (time - before.time) / (after.time - before.time);
  return {time, before.left + share * (after.left - before.left),
          before.right + share * (after.right - before.right)};
}

void TinyslamParser::move(const Wheels& wheels) {
  const Wheels last = moved_.value_or(wheels);
  const double l = kTick * (wheels.left - last.left), r = kTick * (wheels.right - last.right);
  const double turn = (r - l) / kAxle, heading = pose_.phi + turn / 2;
  pose_.x += (l + r) / 2 * std::cos(heading);
  pose_.y += (l + r) / 2 * std::sin(heading);
  pose_.phi = std::remainder(pose_.phi + turn, 2 * M_PI);
  moved_ = wheels;
}

bool isTinyslam(std::string_view name, size_t fields) {
  return fields == kFieldsBeforeRanges + kBeams &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

/// The laser's nominal range is 5.6 m, but it measures up to 4.095 m.
const LogFormat kTinyslamLog{
    "tinyslam", "tinySLAM", "numbers", ".dat", 5.6, isTinyslam, makeParser<TinyslamParser>};

}  // namespace hybrid_slam::readings
