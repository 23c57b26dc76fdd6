/// @file Replay.h
/// @brief A log through a filter into a folder of results.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "run/Configuration.h"

namespace hybrid_slam::run {

/// What a replay came to.
struct ReplayOutcome {
  std::vector<std::string> warnings;  ///< one line each: what was left out or odd in the log
  std::string incomplete;  ///< why the results cover only the first part of the log; empty if they do not
  std::string summary;     ///< one line: scans, updates, time, real-time factor
  std::string profile;     ///< a table of the stages' times; empty unless asked for
};

/// Replays configuration.run.rawlog and writes the result files of doc/results.md to
/// configuration.run.output.
/// @param stop  set from outside (Ctrl-C): the run ends after the present scan and writes its results
/// @param wantsProfile  take the times of the stages
/// @throws InputError for a wrong log or output folder, std::runtime_error if a result cannot be written
ReplayOutcome replay(Configuration& configuration, bool isQuiet, const std::atomic<bool>& stop,
                     const std::string& version, bool wantsProfile = false);

}  // namespace hybrid_slam::run
