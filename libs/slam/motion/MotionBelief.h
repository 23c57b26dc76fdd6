/// @file MotionBelief.h
/// @brief What a particle has learnt of its robot's systematic odometry error.
#pragma once

#include "slam/motion/MotionModel.h"

namespace hybrid_slam {

/// The means of D, C and T as normal distributions, conjugate to the motions that a particle makes: with the
/// regressors x = (d, t) of a step, the value r that the particle drew (less the mean that the options give)
/// and the variance v of the motion model,  information += x x^T / v,  sum += x r / v.
///
/// So the means need not be drawn: the filter is Rao-Blackwellised over them as it is over the map. The
/// paper's [9] learns them by EM from a log that must be there first; motion-model-learn does that.
class MotionBelief {
 public:
  /// `options` with this particle's means and, in the variances, how unsure of them it still is; just as
  /// they are where a term's meanStd is 0.
  MotionModelOptions model(const MotionModelOptions& options) const;
  /// Takes in one step (increments in the robot frame at its start; m, rad).
  void learn(const mrpt::math::TPose2D& odometry, const mrpt::math::TPose2D& motion,
             const MotionModelOptions& options);

 private:
  struct Term {
    MotionTerm model(MotionTerm prior) const;
    void learn(const MotionStep& odometry, double value, const MotionTerm& prior, double minStd);
    double dd = 0, dt = 0, tt = 0;  ///< information that the motions so far hold
    double d = 0, t = 0;            ///< sum
  };
  Term distance_, drift_, turn_;
};

}  // namespace hybrid_slam
