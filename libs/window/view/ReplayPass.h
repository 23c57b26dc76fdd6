/// @file ReplayPass.h
/// @brief One pass of a replay through a log, with a filter for each method.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/TemporaryFolder.h"
#include "readings/RawlogSource.h"
#include "run/FilterRun.h"
#include "window/view/Checkpoints.h"

namespace hybrid_slam::window {

/// One filter, with its results in a temporary folder until an export.
struct Lane {
  Lane(const run::Configuration& all, run::RunOptions::Method method, const std::string& folder);

  /// Writes the results to its folder, unless an earlier call has done so.
  /// @param target  final folder, for config.ini
  /// @return FinishedRun::incomplete
  /// @throws InputError if they cannot be written
  std::string finish(const std::string& file, const readings::RawlogSummary& log, const std::string& target);

  run::Configuration configuration;
  run::FilterRun run;
  FilterWatch watch;
  bool isFinished = false;                  ///< accepts no more scans
  std::optional<run::FinishedRun> results;  ///< once they are written
};

/// The filters and how far they have come.
struct ReplayPass {
  using Method = run::RunOptions::Method;
  using Clock = std::chrono::steady_clock;

  /// @param from  checkpoint to continue from; null: the beginning of the log
  ReplayPass(const run::Configuration& configuration, const std::vector<Method>& methods,
             const readings::RawlogSummary& summary, const std::pair<const size_t, Checkpoint>* from);

  /// Passes the next scan to all filters.
  /// @return events, one per line
  std::vector<std::string> advance();
  /// Returns the state of all filters; empty if one cannot be saved: `stock`, `ortho`, one in a fixed map, or
  /// one that searches for its start.
  std::optional<Checkpoint> checkpoint();
  std::vector<std::string> names() const;  ///< of the methods
  bool isFinished() const;
  bool isOver() const { return isFinished() || hasFailed || !next; }

  std::string file;
  readings::RawlogSummary log;
  readings::RawlogSource source;
  files::TemporaryFolder folder;
  std::vector<std::unique_ptr<Lane>> lanes;
  std::optional<readings::Reading> next;
  double start = 0, time = 0;  ///< s: time of the first scan; time since
  size_t scans = 0;
  bool isOutdated = true;  ///< the published maps are not current
  bool hasFailed = false;  ///< the filter or the log, at the next scan
  Clock::time_point lastScan, lastPicture;
  std::vector<std::shared_ptr<const FilterSnapshot>> pictures;
};

}  // namespace hybrid_slam::window
