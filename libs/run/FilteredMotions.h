/// @file FilteredMotions.h
/// @brief E-step of motion model learning: the motions of the particles of a run.
#pragma once

#include <atomic>
#include <string>

#include "run/Configuration.h"
#include "slam/motion/MotionModelLearner.h"

namespace hybrid_slam::run {

/// Runs the configured filter over its log. Each update yields every particle's motion since the previous
/// update, with its weight before resampling. The filter also samples the motion model once per update, so
/// the parameters have the same meaning; a variance learnt from updates every 0.1 m does not hold for updates
/// every 0.3 m.
///
/// These are filtering posteriors (given the scans so far), each from a full generation of particles. The
/// textbook E-step uses smoothing posteriors (given all scans), from the particle ancestries at the end of
/// the log; but a few updates back, resampling leaves a single common ancestor without spread. Filtering adds
/// no bias: averaged over scans from the true model, the posterior of a step is the model itself for any set
/// of scans, so the true model is a fixed point of EM.
///
/// The weights of the improved proposal are not tempered here: with exponent 0.02 the learnt variance of the
/// distance was 1.4 times too large, and the likelihood was uninformative.
///
/// @param progressNote  shown next to the progress
/// @param stop  set from outside (Ctrl-C)
/// @throws InputError for a wrong log or filter, std::runtime_error if it was stopped
Expectation filteredMotions(const Configuration& configuration, const readings::RawlogSummary& log,
                            bool isQuiet, const std::string& progressNote, const std::atomic<bool>& stop);

}  // namespace hybrid_slam::run
