/// @file MotionModel.h
/// @brief The motion model of the paper's [9] (Eliazar & Parr, ICML 2004): distance, drift and turn.
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CActionRobotMovement2D.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "base/Options.h"
#include "base/RandomStream.h"

namespace hybrid_slam {

/// A pose increment in the direction of the heading halfway through its turn. For odometry, `distance` and
/// `turn` are the model's d and t; sideways motion stays in the drift.
struct MotionStep {
  MotionStep(double distanceAlong, double driftAcross, double turned)
      : distance(distanceAlong), drift(driftAcross), turn(turned) {}
  /// @param increment  in the robot frame at the start of the step (m, rad)
  explicit MotionStep(const mrpt::math::TPose2D& increment);
  mrpt::math::TPose2D increment() const;

  double distance, drift;  ///< along that heading, and across it to the left (m)
  double turn;             ///< rad
};

/// Longest step, m, whose errors grow in proportion to it. A longer one, as after a gap between the scans,
/// counts as several with independent errors: its variance grows in proportion.
constexpr double kLongestStep = 1.5;
/// Returns the d (m) of the variance for a step of the odometry: its square is kLongestStep |d| for steps
/// above kLongestStep. The sideways motion of an omnidirectional robot counts, too, as far as it exceeds the
/// motion along the heading and 2 cm: less is an arc, or an error.
double distanceOfVariance(const MotionStep& odometry);

/// One of D, C, T: a normal distribution that depends on the odometry's translation d (m) and rotation t
/// (rad):  mean = meanD d + meanT t,  variance = varianceD d^2 + varianceT t^2 + minStd^2, plus 2 covariance
/// d t if the means are uncertain (MotionBelief); in the variance, d is distanceOfVariance.
struct MotionTerm {
  double mean(const MotionStep& odometry) const { return meanD * odometry.distance + meanT * odometry.turn; }
  double variance(const MotionStep& odometry, double minStd) const {
    const double d = distanceOfVariance(odometry);
    return varianceD * d * d + varianceT * odometry.turn * odometry.turn +
           2 * covariance * d * odometry.turn + minStd * minStd;
  }

  double meanD, meanT;
  double varianceD, varianceT;
  double meanStd = 0;     ///< prior standard deviation of meanD and meanT (their units); 0: known exactly
  double covariance = 0;  ///< of meanD and meanT, if they are learnt
};

/// Section [motion_model].
struct MotionModelOptions : Options {
  MotionTerm distance{1, 0, 0.0015, 0.0016, 0.01};  ///< D, along heading + T / 2 (m)
  MotionTerm drift{0, 0, 0.0015, 0.0016, 0.03};     ///< C, perpendicular to D, positive to the left (m)
  MotionTerm turn{0, 1, 0.004, 0.006, 0.03};        ///< T (rad)
  double minStdXY = 0.005, minStdPhi = mrpt::DEG2RAD(0.1);
  void describe(OptionTable& table) override;
};

/// A pose increment drawn for one particle from the odometry's increment (both in the robot frame at the
/// start of the step; m, rad): Sec. III-A, step 1.
mrpt::math::TPose2D sampleMotion(const mrpt::math::TPose2D& odometry, const MotionModelOptions& options,
                                 RandomStream& random);

/// Returns the increment that given standard normal numbers for D, C and T select.
mrpt::math::TPose2D sampleMotion(const mrpt::math::TPose2D& odometry, const MotionModelOptions& options,
                                 const std::array<double, 3>& normals);

/// Normal approximation of `sampleMotion`: mean pose after the step and its covariance (x, y, phi; m, rad),
/// in the frame in which `start` is given.
struct MotionDistribution {
  mrpt::math::TPose2D mean;
  Eigen::Matrix3d covariance;
};
/// The motion model from a pose. @param odometry  motion (m, rad), in the robot frame at `start`
MotionDistribution motionDistribution(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& odometry,
                                      const MotionModelOptions& options);

/// The closest Gaussian motion model of MRPT, for MRPT code that does its own sampling. It has one standard
/// deviation for both axes, which includes the systematic error.
mrpt::obs::CActionRobotMovement2D::TMotionModelOptions toMrpt(const MotionModelOptions& options);

/// MRPT's action object for an odometry increment.
mrpt::obs::CActionRobotMovement2D toAction(const mrpt::math::TPose2D& odometry,
                                           const MotionModelOptions& options);

}  // namespace hybrid_slam
