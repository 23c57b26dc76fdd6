/// @file WheelOdometry.h
/// @brief Wheel odometry of a Pioneer 3-DX with systematic and random errors and slips.
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "base/Options.h"

namespace hybrid_slam {
class RandomStream;
}

namespace hybrid_slam::simulation {

/// Error parameters after Eliazar and Parr: a true motion of d metres forwards and t radians is measured as D
/// forwards, C sideways (to the left), T of rotation. For X in {D, C, T}
///
///     X ~ N(d meanXd + t meanXt,  |d| sigmaXd^2 + |t| sigmaXt^2).
///
/// Unlike theirs, the variance grows with |d|, not d^2, so that the error of a path does not depend on the
/// number of readings. For steps of equal length d0 the two agree with s_Xd = sigmaXd^2 / d0.
struct OdometryOptions : Options {
  double rate = 10;
  double meanDd = 1.01, meanDt = 0;         ///< m/m, m/rad
  double meanCd = 0, meanCt = 0;            ///< m/m, m/rad
  double meanTd = mrpt::DEG2RAD(0.1);       ///< rad/m
  double meanTt = 1.01;                     ///< rad/rad
  double sigmaDd = 0.02, sigmaDt = 0.005;   ///< m/sqrt(m), m/sqrt(rad)
  double sigmaCd = 0.005, sigmaCt = 0.005;  ///< m/sqrt(m), m/sqrt(rad)
  double sigmaTd = mrpt::DEG2RAD(0.5);      ///< rad/sqrt(m)
  double sigmaTt = mrpt::DEG2RAD(1.0);      ///< rad/sqrt(rad)
  std::string slips;                        ///< "T DEG M, T DEG M, ..."
  void describe(OptionTable& table) override;
};

/// A slip at `time` (s from the start), which adds this rotation (rad) and forward motion (m) to the
/// odometry.
struct Slip {
  double time = 0, rotation = 0, distance = 0;
};

/// @throws InputError for text that is not "T DEG M, T DEG M, ..."
std::vector<Slip> parseSlips(const std::string& text);

/// Integrates true motions into the odometry pose, which starts at (0, 0, 0).
class WheelOdometry {
 public:
  explicit WheelOdometry(const OdometryOptions& options) : options_(options) {}

  /// Moves the robot by `distance` (m) along an arc of `rotation` (rad).
  void move(double distance, double rotation, RandomStream& random);
  /// Moves only the wheels.
  void slip(const Slip& slip) { advance(slip.distance, 0, slip.rotation); }

  const mrpt::math::TPose2D& pose() const { return pose_; }
  /// Returns the pose as the robot's controller reports it: whole millimetres, and 4096 units per turn.
  mrpt::math::TPose2D reading() const;

 private:
  void advance(double forwards, double sideways, double rotation);

  OdometryOptions options_;
  mrpt::math::TPose2D pose_;
};

}  // namespace hybrid_slam::simulation
