/// @file Determination.h
/// @brief Which parameters of a motion model a log determines.
#pragma once

#include <string>
#include <vector>

#include "slam/motion/MotionModel.h"

namespace hybrid_slam {

/// The odometry of a step and one hypothesis of the true motion (increments in the robot frame at the start
/// of the step; m, rad). The weights of a step's hypotheses sum to 1.
struct MotionSample {
  mrpt::math::TPose2D odometry, motion;
  double weight;
};

/// Undetermined keys, the same for D, C and T, and the reason.
struct Undetermined {
  std::string keys, why;
};

/// The regressors that the log determines, of d, t (means) and d^2, t^2 (variances). They depend on the
/// odometry only, so they are the same for D, C, T and every iteration.
struct Determination {
  bool meanD = true, meanT = true, varianceD = true, varianceT = true;
  std::vector<Undetermined> lacks;

  bool nothing() const { return !(meanD || meanT || varianceD || varianceT); }
};

/// A regressor needs 20 steps in which the robot moved (2 cm) or turned (0.05 rad), which determine a
/// standard deviation to 16 %. Of two proportional regressors only the sum is determined.
Determination determine(const std::vector<MotionSample>& samples);

}  // namespace hybrid_slam
