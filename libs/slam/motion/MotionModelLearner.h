/// @file MotionModelLearner.h
/// @brief Expectation maximisation over the motion model (Eliazar & Parr, ICML 2004).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slam/motion/MotionModelFit.h"

namespace hybrid_slam {

/// What the E-step finds with a model: how the robot may have moved, and how well the scans go with the
/// model.
struct Expectation {
  std::vector<MotionSample> samples;
  double logLikelihood = 0;  ///< ln p(scans | odometry, model) per step, up to a constant of the log
};
using EStep = std::function<Expectation(const MotionModelOptions& model)>;

struct EmIteration {
  int number = 0;  ///< 0: the prior
  MotionModelOptions model;
  double logLikelihood = 0;
};

struct LearntMotionModel {
  EmIteration best;          ///< of the highest likelihood
  bool isConverged = false;  ///< false: the likelihood was still rising
  Determination determined;  ///< what else kept the prior
};

/// E-step and M-step in turns until the likelihood stops rising: two iterations in a row do not exceed the
/// best so far by 1e-4 nats per step. Not one, because a particle filter's likelihood is an estimate, which
/// wavers where the true one rises.
/// @param prior       where it starts; what the log does not determine stays as it is here, but its means
///                    are taken as known (mean_std = 0), and so are those learnt
/// @param report      called for the prior and each iteration
/// @throws InputError  if the log is too short to determine anything; @param where  names it
LearntMotionModel learnMotionModel(MotionModelOptions prior, const EStep& eStep, int maxIterations,
                                   const std::string& where,
                                   const std::function<void(const EmIteration&)>& report);

}  // namespace hybrid_slam
