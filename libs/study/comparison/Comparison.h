/// @file Comparison.h
/// @brief Executes the unfinished runs of a comparison, in parallel and interruptibly.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/comparison/Groups.h"
#include "study/comparison/RunFolder.h"

namespace hybrid_slam::comparison {

/// A run and where its results go.
struct ComparisonRun {
  Run run;
  RunFolder folder;
  RunIdentity identity;
  std::vector<std::string> command;  ///< hybrid-slam with all arguments except the output folder
};

/// Outcome of a sweep.
struct SweepOutcome {
  size_t kept = 0, done = 0, failed = 0;
  bool isInterrupted = false;
};

/// Starts the unfinished runs, seed by seed over all groups, so that an interrupted sweep covers all groups
/// equally.
/// @param onEnd  called for each ended run, with its error if it failed
/// @throws InputError before any run starts, if a finished run differs from the requested one
SweepOutcome runSweep(const std::vector<ComparisonRun>& runs, size_t atOnce, const std::atomic<bool>& stop,
                      const std::function<void(const ComparisonRun&, const std::string& error)>& onEnd);

}  // namespace hybrid_slam::comparison
