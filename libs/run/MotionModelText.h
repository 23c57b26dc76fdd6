/// @file MotionModelText.h
/// @brief Writes a learnt motion model as an INI section and a table.
#pragma once

#include <string>
#include <vector>

#include "slam/motion/MotionModel.h"

namespace hybrid_slam::run {

/// Returns the section [motion_model] of an INI file: `comments` (one line each), then each key with unit and
/// meaning. Values have six digits, more than any log determines.
std::string motionModelSection(const MotionModelOptions& model, const std::vector<std::string>& comments);

/// Header and row of the table of iterations: number, log-likelihood per update, then mean_d, mean_t, var_d,
/// var_t of D, C and T.
std::string motionModelTableHead();
/// The row of an iteration under this head; 0 is the prior.
std::string motionModelTableRow(int iteration, double logLikelihood, const MotionModelOptions& model);

}  // namespace hybrid_slam::run
