/// @file MotionModelFit.h
/// @brief The M-step: the maximum-likelihood motion model of given motions.
#pragma once

#include <vector>

#include "slam/motion/Determination.h"

namespace hybrid_slam {

/// Mean over the steps of ln p(motion | odometry), as a density of D, C and T, whose volume element equals
/// that of the increments.
double logLikelihood(const std::vector<MotionSample>& samples, const MotionModelOptions& model);

/// Starts from `present` and keeps its minimum deviations and the parameters the log does not determine.
/// Never lowers the likelihood of `samples`.
///
/// The means of each of D, C, T are the weighted least-squares fit of the motion, along the heading halfway
/// through its turn, to (d, t) without intercept; the variances are the fit of the squared residuals to (d^2,
/// t^2), at least 0. The paper's [9] weights all steps equally; the longest steps then dominate and the
/// likelihood may fall. Here each step has weight 1 / v for the means and 1 / v^2 for the variances, v its
/// variance in the model, iterated (Fisher scoring).
MotionModelOptions fitMotionModel(const std::vector<MotionSample>& samples, const MotionModelOptions& present,
                                  const Determination& determined);

}  // namespace hybrid_slam
