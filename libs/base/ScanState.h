/// @file ScanState.h
/// @brief A remembered laser scan as bytes (State.h).
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "base/DeskewedScan.h"
#include "base/LaserScan.h"
#include "base/Memory.h"
#include "base/State.h"

namespace hybrid_slam {

/// Reads any scan as a DeskewedScan, which can have an angle for each beam.
template <>
inline std::shared_ptr<mrpt::obs::CObservation2DRangeScan> newShared() {
  return std::make_shared<DeskewedScan>();
}

/// Writes or reads what toLaserScan uses, bit by bit: also ranges that are not numbers, and the sensor's
/// rotation as a matrix. A flag of the first beam says whether the scan has an angle for each beam. Scans
/// without angles have the same bytes as in sessions of older versions.
template <class State>
void visit(State& state, mrpt::obs::CObservation2DRangeScan& scan) {
  auto time = static_cast<int64_t>(scan.timestamp.time_since_epoch().count());
  mrpt::math::TPoint2D at(scan.sensorPose.x(), scan.sensorPose.y());
  Eigen::Matrix3d rotation = scan.sensorPose.getRotationMatrix().asEigen();
  std::vector<uint32_t> ranges(scan.getScanSize());
  constexpr uint8_t kIsValid = 1, kHasAngles = 2;
  std::vector<uint8_t> flags(ranges.size());
  for (size_t i = 0; i < ranges.size(); ++i) {
    const float range = scan.getScanRange(i);
    std::memcpy(&ranges[i], &range, sizeof range);
    flags[i] = scan.getScanRangeValidity(i) ? kIsValid : 0;
  }
  auto* const deskewed = dynamic_cast<DeskewedScan*>(&scan);
  std::vector<double> angles = deskewed ? deskewed->angles : std::vector<double>();
  if (!angles.empty()) flags[0] |= kHasAngles;
  state(time, scan.sensorLabel, at, rotation, scan.aperture, scan.rightToLeft, scan.maxRange, ranges, flags);
  if (!flags.empty() && (flags[0] & kHasAngles)) state(angles);
  if constexpr (State::kIsReading) {
    const bool areAnglesWhole = angles.empty() || (deskewed && angles.size() == ranges.size() &&
                                                   std::all_of(angles.begin(), angles.end(),
                                                               [](double a) { return std::abs(a) < 100; }));
    state.check(flags.size() == ranges.size() && areAnglesWhole && rotation.allFinite() &&
                    std::isfinite(scan.aperture) && at.norm() <= kMaxSensorDistance,
                "a scan is impossible");
    scan.timestamp = mrpt::Clock::time_point(mrpt::Clock::duration(time));
    scan.sensorPose.setRotationMatrix(mrpt::math::CMatrixDouble33(rotation));
    scan.sensorPose.x(at.x), scan.sensorPose.y(at.y);
    if (deskewed) deskewed->angles = std::move(angles);
    resizeScan(scan, ranges.size());
    for (size_t i = 0; i < ranges.size(); ++i) {
      float range;
      std::memcpy(&range, &ranges[i], sizeof range);
      scan.setScanRange(i, range);
      scan.setScanRangeValidity(i, flags[i] & kIsValid);
    }
  }
}

}  // namespace hybrid_slam
