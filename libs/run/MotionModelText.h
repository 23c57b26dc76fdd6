/// @file MotionModelText.h
/// @brief A learnt motion model as people and programs read it.
#pragma once

#include <string>
#include <vector>

#include "slam/motion/MotionModel.h"

namespace hybrid_slam::run {

/// Section [motion_model] of an INI file, each key with its unit and meaning, below `comments` (a line each).
/// Six digits: more than any log determines.
std::string motionModelSection(const MotionModelOptions& model, const std::vector<std::string>& comments);

/// Head and row of a table of iterations: number, log-likelihood per update, then mean_d, mean_t, var_d,
/// var_t of D, C and T.
std::string motionModelTableHead();
std::string motionModelTableRow(int iteration, double logLikelihood, const MotionModelOptions& model);

}  // namespace hybrid_slam::run
