/// @file ScanState.h
/// @brief A remembered laser scan as bytes (State.h).
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstring>
#include <vector>

#include "base/LaserScan.h"
#include "base/State.h"

namespace hybrid_slam {

/// What toLaserScan uses, to the bit: ranges that are not numbers too, and the sensor's rotation as a matrix.
template <class State>
void visit(State& state, mrpt::obs::CObservation2DRangeScan& scan) {
  auto time = static_cast<int64_t>(scan.timestamp.time_since_epoch().count());
  mrpt::math::TPoint2D at(scan.sensorPose.x(), scan.sensorPose.y());
  Eigen::Matrix3d rotation = scan.sensorPose.getRotationMatrix().asEigen();
  std::vector<uint32_t> ranges(scan.getScanSize());
  std::vector<uint8_t> valid(ranges.size());
  for (size_t i = 0; i < ranges.size(); ++i) {
    const float range = scan.getScanRange(i);
    std::memcpy(&ranges[i], &range, sizeof range);
    valid[i] = scan.getScanRangeValidity(i);
  }
  state(time, scan.sensorLabel, at, rotation, scan.aperture, scan.rightToLeft, scan.maxRange, ranges, valid);
  if constexpr (State::kIsReading) {
    state.check(valid.size() == ranges.size() && rotation.allFinite() && std::isfinite(scan.aperture) &&
                    at.norm() <= kMaxSensorDistance,
                "a scan is impossible");
    scan.timestamp = mrpt::Clock::time_point(mrpt::Clock::duration(time));
    scan.sensorPose.setRotationMatrix(mrpt::math::CMatrixDouble33(rotation));
    scan.sensorPose.x(at.x), scan.sensorPose.y(at.y);
    scan.resizeScan(ranges.size());
    for (size_t i = 0; i < ranges.size(); ++i) {
      float range;
      std::memcpy(&range, &ranges[i], sizeof range);
      scan.setScanRange(i, range);
      scan.setScanRangeValidity(i, valid[i]);
    }
  }
}

}  // namespace hybrid_slam
