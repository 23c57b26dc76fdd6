/// @file MotionModelFit.h
/// @brief The M-step: the motion model under which given motions are the most likely.
#pragma once

#include <string>
#include <vector>

#include "motion/MotionModel.h"

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

/// ln p(motion | odometry), the mean over the steps. In D, C and T, whose volume is that of the increments.
double logLikelihood(const std::vector<MotionSample>& samples, const MotionModelOptions& model);

/// Starts from `present`, whose parameters that the log does not determine, and whose least deviations, stay.
/// Never gives a model under which `samples` are less likely.
///
/// For each of D, C, T: the means are the weighted least squares of the motion, seen along the heading in the
/// middle of its turn, on (d, t) without intercept; the variances those of the squared residuals on
/// (d^2, t^2), at least 0. In the paper's M-step every step counts the same, and then the likelihood may
/// fall: the residuals of the longest steps outweigh all others. Here a step counts by the variance that the
/// model gives it, 1 / v for the means and 1 / v^2 for the variances (Fisher scoring), over and over.
MotionModelOptions fitMotionModel(const std::vector<MotionSample>& samples, const MotionModelOptions& present,
                                  const Determination& determined);

}  // namespace hybrid_slam
