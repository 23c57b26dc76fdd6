#include "study/simulation/Laser.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/Degree.h"
#include "base/Errors.h"
#include "base/Memory.h"
#include "base/Numbers.h"
#include "base/RandomStream.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::simulation {
namespace {

constexpr double kEdge = 0.1;  // m: surfaces closer in range than this appear as one

}  // namespace

const LaserSpec& laserSpec(LaserType type) {
  static const LaserSpec lms100{"LMS-100", 270, {{0.5, 50}, {0.25, 25}}, 20, 0.012, 0.001, 0.015};
  // 80 m mode, with readings in whole centimetres.
  static const LaserSpec lms200{"LMS-200", 180, {{1, 75}, {0.5, 37.5}}, 80, 0.010, 0.01, 0.0044};
  return type == LaserType::lms100 ? lms100 : lms200;
}

void LaserOptions::describe(OptionTable& t) {
  t.add("sensor", sensor, {{LaserType::lms100, "LMS-100"}, {LaserType::lms200, "LMS-200"}},
        "scanner model: sets aperture, range, noise and rounding");
  t.add("resolution_deg", resolutionDeg, 0.25, 1, "deg",
        "angle between beams; LMS-100: 0.5 or 0.25, LMS-200: 1 or 0.5");
  t.add("rate", rate, 0.1, 75, "Hz", "scans stored per second, at most the sensor's rate");
  t.add("scan_time", scanTime, 0, 1, "s",
        "time from the first beam of a scan to the last, at most 1 / rate; 0: all at the same time");
  t.add("noise", noise, "false: exact ranges, rounded as by the sensor");
  t.add("mixed_pixels", mixedPixels, "beams that straddle an edge read a range between its two sides");
  t.add("x", x, -1, 1, "m", "sensor position ahead of the robot's centre");
  t.add("y", y, -1, 1, "m", "sensor position to the left of the robot's centre");
  t.addAngle("yaw_deg", yaw, -180, 180, "sensor heading relative to the robot");
}

Laser::Laser(const LaserOptions& options) : options_(options), spec_(laserSpec(options.sensor)) {
  std::string known;
  for (const LaserSpec::Mode& mode : spec_.modes) {
    known += (known.empty() ? "" : " or ") + numberText(mode.resolutionDeg);
    if (mode.resolutionDeg != options.resolutionDeg) continue;
    if (options.rate > mode.rate)
      throw InputError(
          "the " + std::string(spec_.name) + " is slower", "section [laser], key `rate`",
          "expected at most " + numberText(mode.rate) + " Hz at " + numberText(mode.resolutionDeg) + " deg");
    beamCount_ = static_cast<size_t>(std::lround(spec_.apertureDeg / mode.resolutionDeg)) + 1;
  }
  if (options.scanTime * options.rate > 1 + 1e-9)
    throw InputError("a scan takes longer than the time to the next", "section [laser], key `scan_time`",
                     "expected at most 1 / rate = " + numberText(1 / options.rate) + " s");
  if (beamCount_ == 0)
    throw InputError("the " + std::string(spec_.name) + " does not have this resolution",
                     "section [laser], key `resolution_deg`", "expected " + known + " deg");
}

/// @return m, before rounding; infinity if nothing is in range
double Laser::reading(const BuildingPlan& plan, const mrpt::math::TPoint2D& origin, double heading,
                      RandomStream& random) const {
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  // Noise may bring a reading beyond the maximum back into range.
  const double reach = spec_.maxRange + 10 * spec_.sigma;
  double range = plan.castRay(origin, heading, reach).value_or(kNothing);
  if (options_.mixedPixels) {
    const double right = plan.castRay(origin, heading - spec_.divergence / 2, reach).value_or(kNothing);
    const double left = plan.castRay(origin, heading + spec_.divergence / 2, reach).value_or(kNothing);
    if (std::isfinite(left) && std::isfinite(right) && std::abs(left - right) > kEdge)
      range = left + (right - left) * random.uniform();
  }
  return options_.noise ? range + spec_.sigma * random.gaussian() : range;
}

mrpt::obs::CObservation2DRangeScan Laser::scan(const BuildingPlan& plan, const mrpt::math::TPose2D& robotPose,
                                               RandomStream& random) const {
  return scan(
      plan, [&](double) { return robotPose; }, random);
}

mrpt::obs::CObservation2DRangeScan Laser::scan(const BuildingPlan& plan, const Motion& motion,
                                               RandomStream& random) const {
  mrpt::obs::CObservation2DRangeScan observation;
  observation.sensorLabel = "LASER";
  observation.aperture = static_cast<float>(spec_.apertureDeg * kDegree);
  observation.rightToLeft = true;
  observation.maxRange = static_cast<float>(spec_.maxRange);
  observation.stdError = static_cast<float>(spec_.sigma);
  observation.beamAperture = static_cast<float>(spec_.divergence);
  observation.sensorPose = mrpt::poses::CPose3D(options_.x, options_.y, 0, options_.yaw, 0, 0);
  resizeScan(observation, beamCount_);

  const mrpt::math::TPose2D mounting(options_.x, options_.y, options_.yaw);
  const double step = options_.scanTime / static_cast<double>(beamCount_ - 1);  // s
  for (size_t i = 0; i < beamCount_; ++i) {
    const double angle = (static_cast<double>(i) * options_.resolutionDeg - spec_.apertureDeg / 2) * kDegree;
    const auto sensor = motion(static_cast<double>(i) * step) + mounting;
    const double exact = reading(plan, {sensor.x, sensor.y}, sensor.phi + angle, random);
    const double rounded = std::round(exact / spec_.readingStep) * spec_.readingStep;
    const bool valid = rounded < spec_.maxRange;
    observation.setScanRange(
        i, static_cast<float>(valid ? std::max(rounded, spec_.readingStep) : spec_.maxRange));
    observation.setScanRangeValidity(i, valid);
  }
  return observation;
}

}  // namespace hybrid_slam::simulation
