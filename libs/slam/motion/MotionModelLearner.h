/// @file MotionModelLearner.h
/// @brief Expectation maximisation over the motion model (Eliazar & Parr, ICML 2004).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slam/motion/MotionModelFit.h"

namespace hybrid_slam {

/// Result of the E-step: motion hypotheses and the likelihood of the scans.
struct Expectation {
  std::vector<MotionSample> samples;
  double logLikelihood = 0;  ///< ln p(scans | odometry, model) per step, up to a constant
};
using EStep = std::function<Expectation(const MotionModelOptions& model)>;

/// A model and how likely it makes the log.
struct EmIteration {
  int number = 0;  ///< 0: the prior
  MotionModelOptions model;
  double logLikelihood = 0;
};

/// The result of learning.
struct LearntMotionModel {
  EmIteration best;          ///< highest likelihood; 0: no iteration exceeds the prior, which is the model
  bool isConverged = false;  ///< false: the likelihood was still rising
  Determination determined;  ///< which parameters were learnt; the others keep the prior
};

/// Alternates E-step and M-step until two iterations in a row fail to exceed the best likelihood by 1e-4 nats
/// per step. Two, because a particle filter's likelihood is a noisy estimate.
/// @param prior       initial model; undetermined parameters keep its values. Means are known (mean_std = 0)
///                    in the iterations, and in the result if both are learnt; else it keeps the prior's
/// @param report      called for the prior and after each iteration
/// @throws InputError  if the log determines no parameter; @param where  names the log
LearntMotionModel learnMotionModel(const MotionModelOptions& prior, const EStep& eStep, int maxIterations,
                                   const std::string& where,
                                   const std::function<void(const EmIteration&)>& report);

}  // namespace hybrid_slam
