/// @file RoomLog.h
/// @brief For the tests: observations of a robot in a rectangular room, and logs of them in memory.
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CSerializable.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace hybrid_slam::test {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using Log = std::vector<mrpt::serialization::CSerializable::Ptr>;

constexpr double kHalfLength = 5, kHalfWidth = 3;  ///< m, of the room around the origin, along x and y
constexpr double kRoomArea = 4 * kHalfLength * kHalfWidth;  ///< m^2
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

inline mrpt::Clock::time_point stamp(double time) {
  return std::isnan(time) ? INVALID_TIMESTAMP : mrpt::Clock::fromDouble(time);
}

/// Distance (m) to the room's walls from a point in it.
inline double rangeInRoom(double x, double y, double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  const double alongX =
      c == 0 ? std::numeric_limits<double>::infinity() : (std::copysign(kHalfLength, c) - x) / c;
  const double alongY =
      s == 0 ? std::numeric_limits<double>::infinity() : (std::copysign(kHalfWidth, s) - y) / s;
  return std::min(alongX, alongY);
}

/// Scan of the room by a 180 deg laser at the robot's centre. Its first three ranges are up to 9 um too
/// long, depending on the time, since no two scans of a real laser are equal.
inline CObservation2DRangeScan::Ptr scan(double time, const TPose2D& pose = {}, size_t beams = 181,
                                         const std::string& label = "LASER") {
  auto out = CObservation2DRangeScan::Create();
  out->timestamp = stamp(time);
  out->sensorLabel = label;
  out->aperture = static_cast<float>(M_PI);
  out->maxRange = 20;
  out->rightToLeft = true;
  out->resizeScan(beams);
  for (size_t i = 0; i < beams; ++i) {
    const double angle =
        (static_cast<double>(i) / static_cast<double>(std::max<size_t>(beams, 2) - 1) - 0.5) * M_PI;
    out->setScanRange(i, static_cast<float>(rangeInRoom(pose.x, pose.y, pose.phi + angle)));
    out->setScanRangeValidity(i, true);
  }
  for (size_t i = 0; i < std::min<size_t>(beams, 3) && std::isfinite(time); ++i) {
    const double number = 1000 * std::sin((static_cast<double>(i) + 1) * 12.9898 * time);
    out->setScanRange(i, out->getScanRange(i) + static_cast<float>(9e-6 * (number - std::floor(number))));
  }
  return out;
}

inline mrpt::obs::CObservationOdometry::Ptr odometry(double time, const TPose2D& pose) {
  auto out = mrpt::obs::CObservationOdometry::Create();
  out->timestamp = stamp(time);
  out->sensorLabel = "ODOMETRY";
  out->odometry = mrpt::poses::CPose2D(pose);
  return out;
}

inline mrpt::obs::CActionCollection::Ptr action(const TPose2D& increment) {
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry(mrpt::poses::CPose2D(increment), {});
  auto out = mrpt::obs::CActionCollection::Create();
  out->insert(movement);
  return out;
}

inline mrpt::obs::CSensoryFrame::Ptr frame(const std::vector<CObservation2DRangeScan::Ptr>& scans) {
  auto out = mrpt::obs::CSensoryFrame::Create();
  for (const auto& s : scans) out->insert(s);
  return out;
}

/// The robot's pose after `step` of `stepsPerLap` steps counter-clockwise round an ellipse of 4 m by 2 m in
/// the room.
inline TPose2D poseOnLap(size_t step, size_t stepsPerLap) {
  const double a = 2 * M_PI * static_cast<double>(step) / static_cast<double>(stepsPerLap);
  return {2 * std::cos(a), std::sin(a), std::atan2(std::cos(a), -2 * std::sin(a))};
}

/// Laps in the room as observations only: an odometry reading and a scan at the same time, 5 per second from
/// 1000 s on.
inline Log laps(size_t steps, size_t stepsPerLap = 80, size_t beams = 181) {
  Log log;
  for (size_t i = 0; i < steps; ++i) {
    const double time = 1000 + 0.2 * static_cast<double>(i);
    const TPose2D pose = poseOnLap(i, stepsPerLap);
    log.push_back(odometry(time, pose));
    log.push_back(scan(time, pose, beams));
  }
  return log;
}

/// The same with the odometry of laps in the other direction, which no filter can map.
inline Log lapsWithMirroredOdometry(size_t steps) {
  Log log = laps(steps);
  for (size_t i = 0; i < steps; ++i) {
    TPose2D pose = poseOnLap(i, 80);
    pose.y = -pose.y, pose.phi = -pose.phi;
    log[2 * i] = odometry(1000 + 0.2 * static_cast<double>(i), pose);
  }
  return log;
}

}  // namespace hybrid_slam::test
