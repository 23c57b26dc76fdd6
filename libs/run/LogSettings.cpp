#include "run/LogSettings.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/DeskewedScan.h"
#include "base/Errors.h"
#include "base/LaserScan.h"
#include "base/Numbers.h"
#include "run/OdometryTimeOffset.h"
#include "run/RobotParts.h"
#include "slam/filter/MountingEstimate.h"

namespace hybrid_slam::run {
namespace {

constexpr size_t kReadings = 2000, kMostBeams = 10'000'000;  // the first of a log
constexpr double kUsualRange = 20, kLongestRange = 80;       // m
constexpr double kNoLimit = 200;                             // m; upper bound of grid.max_range
constexpr double kSparseStep = 0.3;                          // m; the standard proposal's update distance
constexpr double kCentimetre = 0.01;                         // m
constexpr double kSparsePoints = 0.1;                        // m between neighbours on a wall
constexpr double kLeastDriven = 30, kFullTurn = 2 * M_PI;    // m, rad
constexpr double kMargin = 0.05;                             // m
constexpr double kFarOff = mrpt::DEG2RAD(15.0);              // the filter copes with less
constexpr double kLargeOffset = 0.25;                        // s
constexpr double kHalfBeam =
    mrpt::DEG2RAD(1.0);  // logs of other formats begin with a beam, not with half a step

/// Returns the value (m) that a laser logs for no return; 0 if it marks these beams as invalid. Some lasers
/// log one value, or several close together, for all of them, with few returns just below.
double noReturn(const std::vector<float>& ranges) {
  if (ranges.empty()) return 0;
  const double longest = *std::max_element(ranges.begin(), ranges.end());
  const double lowest = 0.998 * longest;
  const auto within = [&](double low, double high) {
    return static_cast<double>(
        std::count_if(ranges.begin(), ranges.end(), [&](float r) { return r >= low && r < high; }));
  };
  const double share = within(lowest, 2 * longest) / static_cast<double>(ranges.size());
  const bool isCode =
      share > 0.01 && share < 0.5 && within(lowest, 2 * longest) > 10 * within(0.95 * longest, lowest);
  return isCode ? std::floor(lowest / kCentimetre) * kCentimetre : 0;
}

/// The largest value at or below the interpolated quantile (method `lower` of NumPy).
/// @param values  at least one
double lowerQuantile(std::vector<float> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// @param limit  m, the largest that the log states for a laser
LogSetting maxRange(std::vector<float> ranges, double limit) {
  const auto setting = [](double value, const std::string& reason) {
    return LogSetting{"grid", "max_range", fixedText(value, value == std::round(value) ? 0 : 2), reason};
  };
  const double code = noReturn(ranges);
  const std::string codeText = "the laser logs " + fixedText(code, 2) + " m and more for no return";
  if (code > 0)
    ranges.erase(std::remove_if(ranges.begin(), ranges.end(), [&](float r) { return r >= code; }),
                 ranges.end());
  const double most = ranges.empty() ? 0 : lowerQuantile(ranges, 0.95);
  const double useful = std::clamp(10 * std::ceil(most / 10), kUsualRange, kLongestRange);
  if (code > 0 && code <= std::min(useful, limit)) return setting(code, codeText);
  if (limit <= useful) return setting(limit, "the log's limit for the laser");
  return setting(useful, std::string(useful > kUsualRange ? "" : "the default: ") +
                             "95 % of the returns are within " + fixedText(most, 1) + " m");
}

/// @param spacings  m, of each of the ranges: to the return of the beam before, 0 without one
std::vector<LogSetting> cellSize(const std::vector<float>& ranges, const std::vector<float>& spacings) {
  const double code = noReturn(ranges);
  std::vector<float> onWalls;
  for (size_t i = 0; i < ranges.size(); ++i)
    if (spacings[i] > 0 && (code == 0 || ranges[i] < code)) onWalls.push_back(spacings[i]);
  const double spacing = onWalls.empty() ? 0 : lowerQuantile(std::move(onWalls), 0.5);
  if (spacing <= kSparsePoints) return {};
  return {{"grid", "resolution", "0.1", "neighbouring beams end " + fixedText(spacing, 2) + " m apart"}};
}

LogSetting directionNoise(const std::vector<float>& ranges) {
  const auto inCentimetres = std::count_if(ranges.begin(), ranges.end(), [](float r) {
    const double n = r / kCentimetre;
    return std::abs(n - std::round(n)) < 1e-3;
  });
  const bool isCoarse = 10 * inCentimetres > 9 * static_cast<std::ptrdiff_t>(ranges.size());
  return {"line_weight", "sigma_deg", isCoarse ? "0.5" : "0.4",
          isCoarse ? "ranges in steps of 1 cm" : "ranges in steps finer than 1 cm"};
}

/// @param steps  m between readings, of the moving robot
std::vector<LogSetting> updates(std::vector<float> steps) {
  if (steps.empty()) return {};
  const double step = lowerQuantile(std::move(steps), 0.5);
  const bool isSparse = step > kSparseStep;
  const std::string reason = "scans " + fixedText(step, 2) + " m apart" + (isSparse ? ": use every one" : "");
  return {{"improved_proposal", "update_distance", isSparse ? "0.02" : "0.1", reason},
          {"improved_proposal", "update_angle_deg", isSparse ? "1" : "5", reason}};
}

/// @param mounting  pose of the laser on the robot
std::string describe(const mrpt::obs::CObservation2DRangeScan& observation,
                     const mrpt::poses::CPose3D& mounting) {
  const auto placed = copyOf(observation);
  placed->sensorPose = mounting;  // that of a reading includes the robot's motion
  const LaserScan scan = toLaserScan(*placed, kNoLimit);
  const auto degrees = [](double angle) {
    return numberText(std::round(mrpt::RAD2DEG(angle) * 1e3) / 1e3 + 0.0);
  };  // not -0
  std::string text = std::to_string(scan.beams.size()) + " beams";
  if (scan.beams.size() > 1)
    text += " every " +
            degrees((scan.beams.back().angle - scan.beams.front().angle) /
                    static_cast<double>(scan.beams.size() - 1)) +
            " deg";
  return text + ", at x " + fixedText(scan.sensorPose.x, 2) + " m, y " + fixedText(scan.sensorPose.y, 2) +
         " m, " + degrees(scan.sensorPose.phi) + " deg on the robot";
}

/// Where the log gives the only laser no place on the robot: its heading, if that is far from zero.
std::vector<LogSetting> laserPose(const std::vector<readings::Reading>& first,
                                  const readings::RawlogSummary& log) {
  if (log.lasers.size() != 1 || log.mountings.empty() || !log.hasMotion || !log.hasTurns) return {};
  const mrpt::poses::CPose3D& given = log.mountings.begin()->second;
  if (given.norm() > kCentimetre || std::abs(given.yaw()) > kHalfBeam || std::abs(given.roll()) > kHalfBeam)
    return {};
  MountingEstimate estimate{GridOptions(), ScanMatcherOptions()};
  for (const readings::Reading& reading : first) {
    if (estimate.isDone()) break;
    estimate.add(reading.motion, reading.scans, reading.timestamp);
  }
  const auto yaw = estimate.yaw();
  if (!yaw || std::abs(*yaw) < kFarOff) return {};
  return {{"input", "laser_pose",
           "0, 0, " + fixedText(mrpt::RAD2DEG(mrpt::math::wrapToPi(given.yaw() + *yaw)), 0),
           "the log does not state it, and its scans move like this"}};
}

/// A little more than the longest range at the robot's own parts.
std::vector<LogSetting> minRange(const std::vector<readings::Reading>& first) {
  RobotParts parts;
  for (const readings::Reading& reading : first) parts.add(reading);
  const double farthest = parts.farthest();
  if (farthest == 0) return {};
  return {{"input", "min_range", fixedText(farthest + kMargin, 2),
           "some beams always measure up to " + fixedText(farthest, 2) + " m: the robot itself"}};
}

/// The time offset of the odometry, where it is large: the filter copes with less.
std::vector<LogSetting> odometryTimeOffset(const std::vector<readings::Reading>& first,
                                           const readings::RawlogSummary& log) {
  if (!log.hasOdometryReadings) return {};  // actions have no time
  OdometryTimeOffset offset;
  for (const readings::Reading& reading : first) offset.add(reading);
  const auto found = offset.seconds();
  if (!found || std::abs(*found) < kLargeOffset) return {};
  return {{"input", "odometry_time_offset", fixedText(*found, 2),
           std::string("the odometry turns ") + (*found < 0 ? "later" : "earlier") + " than the scans"}};
}

/// Returns the first readings, up to one that the run will report as an error: kReadings, and more as long as
/// the robot has hardly moved.
std::vector<readings::Reading> firstReadings(const std::string& file, readings::InputOptions input,
                                             const readings::RawlogSummary& log) {
  input.scanTime = 0, input.scanRate.reset();  // the ranges as logged, not as corrected by the motion
  input.odometryTimeOffset = 0;                // to be estimated
  readings::RawlogSource source(file, input, log);
  std::vector<readings::Reading> all;
  size_t beams = 0;
  double way = 0, turned = 0;
  const auto hasMoved = [&] {
    return (!log.hasMotion || way >= kLeastDriven) && (!log.hasTurns || turned >= kFullTurn);
  };
  try {
    while ((all.size() < kReadings || !hasMoved()) && beams < kMostBeams) {
      const auto reading = source.next();
      if (!reading) break;
      all.push_back(*reading);
      way += reading->motion.norm();
      turned += std::abs(reading->motion.phi);
      for (const auto& scan : reading->scans) beams += scan->getScanSize();
    }
  } catch (const InputError&) {
  }
  return all;
}

}  // namespace

LogSettings readLogSettings(const std::string& file, const readings::InputOptions& input,
                            const readings::RawlogSummary& log) {
  std::map<std::string, std::string> lasers;
  std::vector<float> ranges, spacings, steps;
  double limit = 0;  // m
  const std::vector<readings::Reading> first = firstReadings(file, input, log);
  for (const readings::Reading& reading : first) {
    if (reading.motion.norm() > 0.01 || std::abs(reading.motion.phi) > mrpt::DEG2RAD(0.5))
      steps.push_back(static_cast<float>(reading.motion.norm()));
    for (const auto& observation : reading.scans) {
      const LaserScan scan = toLaserScan(*observation, kNoLimit);
      const std::string& label = observation->sensorLabel;
      const auto mounting = log.mountings.find(label);  // none if the log has changed
      if (lasers.count(label) == 0 && mounting != log.mountings.end())
        lasers[label] = describe(*observation, mounting->second);
      limit = std::max(limit, scan.maxRange);
      const Beam* last = nullptr;
      for (const Beam& beam : scan.beams) {
        if (!beam.valid) continue;
        ranges.push_back(static_cast<float>(beam.range));
        spacings.push_back(last ? static_cast<float>(beam.range * std::abs(beam.angle - last->angle)) : 0);
        last = &beam;
      }
    }
  }
  for (const std::string& label : log.lasers)
    lasers.try_emplace(label, "no scan in the first " + std::to_string(first.size()) + " readings");
  LogSettings found;
  found.hasOdometry = log.hasActions || log.hasOdometryReadings;
  for (const auto& [label, text] : lasers) {
    const auto sweep = log.sweeps.find(label);
    const bool isDeskewed = log.isDeskewed && sweep != log.sweeps.end();
    found.lasers.push_back((label.empty() ? "laser: " : "laser " + label + ": ") + text +
                           (isDeskewed ? ", corrected for motion during its scans of " +
                                             fixedText(1000 * sweep->second, 1) + " ms"
                                       : ""));
  }
  found.settings = cellSize(ranges, spacings);
  for (const LogSetting& setting : updates(std::move(steps))) found.settings.push_back(setting);
  if (!log.hasMotion && log.hasTurns)
    found.settings.push_back({"input", "heading_odometry", "true",
                              "the odometry's position never changes: scan matching gives it"});
  else if (!log.hasMotion)
    found.settings.push_back({"input", "require_odometry", "false",
                              std::string(found.hasOdometry ? "odometry that never changes" : "no odometry") +
                                  ": motion is predicted from the previous steps"});
  for (const LogSetting& setting : odometryTimeOffset(first, log)) found.settings.push_back(setting);
  for (const LogSetting& setting : minRange(first)) found.settings.push_back(setting);
  for (const LogSetting& setting : laserPose(first, log)) found.settings.push_back(setting);
  found.settings.insert(found.settings.begin(), {maxRange(ranges, limit), directionNoise(ranges)});
  return found;
}

std::vector<std::string> applyLogSettings(const LogSettings& log, Configuration& configuration) {
  std::vector<std::string> lines = log.lasers;
  const bool hasMap = !configuration.run.continueFrom.empty() || !configuration.run.localizeIn.empty();
  for (const auto& [section, key, value, reason] : log.settings)
    if (!(hasMap && key == "resolution") && configuration.setDefault(section, key, value))
      lines.push_back(section + "." + key + " = " + value + ": " + reason);
  if (!log.hasOdometry && configuration.input.requireOdometry)
    throw InputError("no odometry", "section [input], key `require_odometry`",
                     "expected a log with odometry, or require_odometry = false");
  return lines;
}

}  // namespace hybrid_slam::run
