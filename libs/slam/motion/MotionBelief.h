/// @file MotionBelief.h
/// @brief A particle's estimate of the systematic odometry error.
#pragma once

#include "slam/motion/MotionModel.h"

namespace hybrid_slam {

/// Normal distributions of the means of D, C and T, conjugate to the particle's motions. With the regressors
/// x = (d, t) of a step, the drawn value r (minus the mean in the options) and the variance v of the motion
/// model: information += x x^T / v,  sum += x r / v.
///
/// The filter is thus Rao-Blackwellized over the means, as it is over the map. The paper's [9] learns them by
/// EM from a recorded log instead, as motion-model-learn does.
class MotionBelief {
 public:
  /// `options` with this particle's means, and variances increased by their uncertainty; terms with meanStd 0
  /// are unchanged.
  MotionModelOptions model(const MotionModelOptions& options) const;
  /// Updates with one step (increments in the robot frame at its start; m, rad).
  void learn(const mrpt::math::TPose2D& odometry, const mrpt::math::TPose2D& motion,
             const MotionModelOptions& options);

  /// Returns whether model() is plausible for a robot; one read from damaged bytes may not be.
  bool isPlausible(const MotionModelOptions& options) const;

  template <class State>
  void visit(State& state) {
    state(distance_, drift_, turn_);
  }

 private:
  struct Term {
    MotionTerm model(MotionTerm prior) const;
    void learn(const MotionStep& odometry, double value, const MotionTerm& prior, double minStd);
    double dd = 0, dt = 0, tt = 0;  ///< information of the motions so far
    double d = 0, t = 0;            ///< sum

    template <class State>
    void visit(State& state) {
      state(dd, dt, tt, d, t);
    }
  };
  Term distance_, drift_, turn_;
};

}  // namespace hybrid_slam
