/// @file Determination.h
/// @brief What a log of motions can tell of a motion model at all.
#pragma once

#include <string>
#include <vector>

#include "slam/motion/MotionModel.h"

namespace hybrid_slam {

/// What the odometry said of a step, and one hypothesis of how the robot really moved (both increments in the
/// robot frame at the start of the step; m, rad). The weights of a step's hypotheses sum up to 1.
struct MotionSample {
  mrpt::math::TPose2D odometry, motion;
  double weight;
};

/// Keys of D, of C and of T alike, and what the log lacks for them.
struct Undetermined {
  std::string keys, why;
};

/// Which of the regressors d, t (of the means) and d^2, t^2 (of the variances) a log tells apart. That is the
/// odometry's affair alone, so it is the same for D, C and T, and in every iteration.
struct Determination {
  bool meanD = true, meanT = true, varianceD = true, varianceT = true;
  std::vector<Undetermined> lacks;

  bool nothing() const { return !(meanD || meanT || varianceD || varianceT); }
};

/// A regressor takes 20 steps in which the robot moved (2 cm) or turned (0.05 rad), for a standard deviation
/// is known to 16 % from so many; and two regressors proportional to each other say only something of their
/// sum.
Determination determine(const std::vector<MotionSample>& samples);

}  // namespace hybrid_slam
