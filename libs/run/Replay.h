/// @file Replay.h
/// @brief Replays a log through a filter and writes the results.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "run/Configuration.h"
#include "run/Verdict.h"

namespace hybrid_slam::run {

/// Outcome of a replay.
struct ReplayOutcome {
  std::vector<std::string> warnings;  ///< one line each: skipped or anomalous entries
  std::string incomplete;  ///< why the results cover only the first part of the log; empty if complete
  std::string summary;     ///< one line: scans, updates, time, real-time factor
  Verdict verdict;         ///< whether the map can be trusted
  std::string profile;     ///< table of stage times; empty unless requested
};

/// Completes the configuration with settings from the log (LogSettings.h), and prints them on standard output
/// unless quiet. Replays configuration.run.rawlog and writes the result files of doc/results.md to
/// configuration.run.output. A resumed run takes configuration, log and output from the session (Resume.h).
/// @param stop  set from outside (Ctrl-C): the run ends after the current scan and writes its results
/// @param wantsProfile  measure stage times
/// @throws InputError for a wrong log or output folder, or a result that cannot be written;
///         std::runtime_error if the run ends before its first scan, without results
ReplayOutcome replay(Configuration& configuration, bool isQuiet, const std::atomic<bool>& stop,
                     bool wantsProfile = false);

}  // namespace hybrid_slam::run
