#include "base/LaserScan.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>

#include "base/BeamFan.h"
#include "base/Errors.h"

namespace hybrid_slam {

bool isHorizontal(const mrpt::obs::CObservation2DRangeScan& observation) {
  constexpr double kMaxTilt = mrpt::DEG2RAD(5.0);
  return std::abs(observation.sensorPose.getRotationMatrix()(2, 2)) >= std::cos(kMaxTilt);
}

LaserScan toLaserScan(const mrpt::obs::CObservation2DRangeScan& observation, double maxRange) {
  if (!isHorizontal(observation))
    throw InputError("the laser's scan plane is tilted", "sensor `" + observation.sensorLabel + "`",
                     "expected a horizontal plane within 5 deg, upright or upside down");
  const BeamFan fan(observation);
  LaserScan scan;
  scan.timestamp = observation.timestamp;
  scan.sensorPose = fan.sensorPose();
  scan.maxRange = observation.maxRange > 0 ? std::min<double>(maxRange, observation.maxRange) : maxRange;

  const size_t n = fan.beams();
  const size_t every = std::max<size_t>(1, (n + kMostScanBeams - 1) / kMostScanBeams),
               count = (n + every - 1) / every;
  scan.beams.resize(count);
  for (size_t i = 0; i < count; ++i) {
    Beam& beam = scan.beams[fan.isReversed() ? count - 1 - i : i];
    const size_t logged = i * every;
    beam.angle = fan.angle(logged);
    beam.range = observation.getScanRange(logged);
    beam.valid = observation.getScanRangeValidity(logged) && std::isfinite(beam.range) && beam.range > 0 &&
                 beam.range < scan.maxRange;
  }
  return scan;
}

LaserScans toLaserScans(const Scans& scans, double maxRange) {
  if (scans.size() > kMaxLasers)
    throw InputError("too many lasers", std::to_string(scans.size()) + " scans in one reading",
                     "expected at most " + std::to_string(kMaxLasers));
  LaserScans all;
  for (const auto& scan : scans) all.push_back(toLaserScan(*scan, maxRange));
  return all;
}

}  // namespace hybrid_slam
