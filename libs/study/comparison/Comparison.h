/// @file Comparison.h
/// @brief All runs of a comparison: what is left to do is done, in parallel and interruptible.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/comparison/Groups.h"
#include "study/comparison/RunFolder.h"

namespace hybrid_slam::comparison {

struct ComparisonRun {
  Run run;
  RunFolder folder;
  RunIdentity identity;
  std::vector<std::string> command;  ///< hybrid-slam with all its arguments but the output folder
};

/// How the runs of a sweep ended.
struct SweepOutcome {
  size_t kept = 0, done = 0, failed = 0;
  bool isInterrupted = false;
};

/// Starts the runs that are not finished, seed by seed over all groups, so that a sweep that is stopped early
/// has all groups alike.
/// @param onEnd  told of each run that ended, with its error if it failed
/// @throws InputError before anything is started, if a finished run is not the one that is asked for
SweepOutcome runSweep(const std::vector<ComparisonRun>& runs, size_t atOnce, const std::atomic<bool>& stop,
                      const std::function<void(const ComparisonRun&, const std::string& error)>& onEnd);

}  // namespace hybrid_slam::comparison
