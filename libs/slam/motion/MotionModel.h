/// @file MotionModel.h
/// @brief The motion model of the paper's [9] (Eliazar & Parr, ICML 2004): distance, drift and turn.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CActionRobotMovement2D.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "base/Options.h"
#include "base/RandomStream.h"

namespace hybrid_slam {

/// A pose increment seen along the heading in the middle of its turn. Of the odometry, `distance` and `turn`
/// are the model's d and t; what it moved sideways stays in the drift.
struct MotionStep {
  MotionStep(double distanceAlong, double driftAcross, double turned)
      : distance(distanceAlong), drift(driftAcross), turn(turned) {}
  /// @param increment  in the robot frame at the start of the step (m, rad)
  explicit MotionStep(const mrpt::math::TPose2D& increment);
  mrpt::math::TPose2D increment() const;

  double distance, drift;  ///< along that heading, and across it to the left (m)
  double turn;             ///< rad
};

/// One of D, C, T: normal with a mean and a variance that grow with the odometry's translation d (m) and
/// rotation t (rad):  mean = meanD d + meanT t,  variance = varianceD d^2 + varianceT t^2 + minStd^2, and
/// 2 covariance d t beside where the means are not quite known (MotionBelief).
struct MotionTerm {
  double mean(const MotionStep& odometry) const { return meanD * odometry.distance + meanT * odometry.turn; }
  double variance(const MotionStep& odometry, double minStd) const {
    return varianceD * odometry.distance * odometry.distance + varianceT * odometry.turn * odometry.turn +
           2 * covariance * odometry.distance * odometry.turn + minStd * minStd;
  }

  double meanD, meanT;
  double varianceD, varianceT;
  double meanStd = 0;     ///< how far meanD and meanT may lie off (their units); 0: they are known
  double covariance = 0;  ///< of meanD and meanT, where they are learnt
};

/// Section [motion_model].
struct MotionModelOptions : Options {
  MotionTerm distance{1, 0, 0.0015, 0.0016, 0.01};  ///< D, along heading + T / 2 (m)
  MotionTerm drift{0, 0, 0.0015, 0.0016, 0.03};     ///< C, perpendicular to D, positive to the left (m)
  MotionTerm turn{0, 1, 0.004, 0.006, 0.03};        ///< T (rad)
  double minStdXY = 0.005, minStdPhi = 0.1 * M_PI / 180;
  void describe(OptionTable& table) override;
};

/// A pose increment drawn for one particle from the odometry's increment (both in the robot frame at the
/// start of the step; m, rad): Sec. III-A, step 1.
mrpt::math::TPose2D sampleMotion(const mrpt::math::TPose2D& odometry, const MotionModelOptions& options,
                                 RandomStream& random);

/// The same from standard normal numbers that were drawn elsewhere, for D, C and T.
mrpt::math::TPose2D sampleMotion(const mrpt::math::TPose2D& odometry, const MotionModelOptions& options,
                                 const std::array<double, 3>& normals);

/// The normal distribution nearest to `sampleMotion`: the mean pose after the step, and its covariance
/// (x, y, phi) in the frame that `start` is given in.
struct MotionDistribution {
  mrpt::math::TPose2D mean;
  Eigen::Matrix3d covariance;
};
MotionDistribution motionDistribution(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& odometry,
                                      const MotionModelOptions& options);

/// MRPT's Gaussian motion model nearest to this one, for code of MRPT that draws by itself: it knows one
/// deviation for both axes, and a systematic error only as a part of it.
mrpt::obs::CActionRobotMovement2D::TMotionModelOptions toMrpt(const MotionModelOptions& options);

/// The action that MRPT's filters take for an odometry increment.
mrpt::obs::CActionRobotMovement2D toAction(const mrpt::math::TPose2D& odometry,
                                           const MotionModelOptions& options);

}  // namespace hybrid_slam
