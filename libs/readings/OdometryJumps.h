/// @file OdometryJumps.h
/// @brief Detects odometry that the robot cannot have driven.
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <optional>

namespace hybrid_slam::readings {

/// Largest step (m) between two odometry readings. A larger one means two logs in one file, reset odometry,
/// or an error.
constexpr double kMaxStep = 100;
/// Returns whether a heading is possible. Headings that are not wrapped grow with each turn of the robot.
inline bool isHeading(double phi) { return std::abs(phi) <= 1e6; }
/// Returns whether an odometry reading is possible: finite, within 1e8 m (map coordinates, UTM, reach 1e7 m)
/// and 1e6 rad.
inline bool isPossible(const mrpt::math::TPose2D& reading) {
  return reading.norm() <= 1e8 && isHeading(reading.phi);
}
/// Returns whether two odometry readings are over kMaxStep apart, or a heading is impossible.
inline bool isJump(const mrpt::math::TPose2D& before, const mrpt::math::TPose2D& now) {
  return !((now - before).norm() <= kMaxStep) || !isHeading(before.phi) || !isHeading(now.phi);
}

/// Detects the readings to which the odometry has jumped: a step of over kMaxStep, or one of over 0.5 m at
/// more than five times the robot's highest speed so far (at least 1 m/s, so that it may start to move).
/// Counters that restart and readings with bit errors jump so; no robot accelerates like this. A second such
/// step that continues the first one is a motion: the log begins on a fast vehicle.
class OdometryJumps {
 public:
  /// Takes the next possible reading.
  /// @param time  s; 1 s is assumed between readings if it is empty, repeated or steps back
  bool isJump(const mrpt::math::TPose2D& reading, std::optional<double> time);

 private:
  struct Reading {
    mrpt::math::TPoint2D at;
    std::optional<double> time;
  };
  std::optional<Reading> last_;
  mrpt::math::TPoint2D fast_{0, 0};   ///< m/s, of the previous step if it was a jump
  double fastest_ = 1;                ///< m/s
  mrpt::math::TPoint2D moved_{0, 0};  ///< m, since the speed was measured last
  double elapsed_ = 0;                ///< s, since then
};

}  // namespace hybrid_slam::readings
