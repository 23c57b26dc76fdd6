/// @file FilteredMotions.h
/// @brief The E-step of learning a motion model: how the particles of a run moved.
#pragma once

#include <atomic>
#include <string>

#include "run/Configuration.h"
#include "slam/motion/MotionModelLearner.h"

namespace hybrid_slam::run {

/// Runs the configured filter over its log and takes, at each update, how every particle moved since the
/// update before, with the particle's weight before resampling. The filter samples the motion model once for
/// an update, too, so that the parameters mean the same on both sides; a variance learnt from updates every
/// 0.1 m is not one for updates every 0.3 m.
///
/// These are the posteriors of the steps given the scans so far, each of a whole generation of particles.
/// Given all scans, as in the textbook's E-step, they would be the ancestries at the end of the log, but
/// resampling has left them one common ancestor some updates back, and so no spread. Fewer scans are no bias:
/// averaged over scans that go with the true model, the posterior of a step is the model itself, whichever
/// scans it is given, so that EM rests at the true model.
///
/// The weights of the improved proposal are not tempered here: with exponent 0.02 the variance of the
/// distance came out 1.4 times too large, and the likelihood said little.
///
/// @param progressNote  stands beside the progress
/// @param stop          set from outside (Ctrl-C)
/// @throws InputError for a wrong log or filter, std::runtime_error if it was stopped
Expectation filteredMotions(const Configuration& configuration, const readings::RawlogSummary& log,
                            bool isQuiet, const std::string& progressNote, const std::atomic<bool>& stop);

}  // namespace hybrid_slam::run
