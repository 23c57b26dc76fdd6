/// @file MotionModelFit.h
/// @brief The M-step: the motion model under which given motions are the most likely.
#pragma once

#include <vector>

#include "slam/motion/Determination.h"

namespace hybrid_slam {

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
