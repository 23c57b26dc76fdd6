/// @file LiveRun.h
/// @brief A live run: records cycles, filters them and writes results.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "live/CycleSource.h"
#include "live/EventLog.h"
#include "live/LiveOptions.h"
#include "live/Recording.h"
#include "live_run/ReadingQueue.h"
#include "readings/ReadingAssembler.h"
#include "run/Configuration.h"
#include "run/FilterRun.h"
#include "run/VerdictCheck.h"

namespace hybrid_slam::live {

/// How long (s) the results wait for the readings that the filter has not processed when a user ends the run.
constexpr double kPatience = 10;

/// The caller's thread records and pairs readings; a second thread filters. Replaying the recording with
/// hybrid-slam gives the same readings and, if none was skipped, identical results.
class LiveRun {
 public:
  /// @param configuration  must contain [live] and outlive the run
  /// @param isQuiet        no status lines
  /// @throws InputError for wrong settings, or an output folder that cannot be written to
  LiveRun(run::Configuration& configuration, const LiveOptions& options, EventLog& log, bool isQuiet);
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// A function called in the filter's thread after each scan; `isUpdate` says whether it caused an update.
  /// Set it before the first cycle.
  using Watcher = std::function<void(const FilterView&, const readings::Reading&, bool isUpdate)>;
  void setWatcher(Watcher watcher) { watcher_ = std::move(watcher); }

  /// Seconds between status lines, and between verdicts on the map so far, which are reported when they
  /// change; 10 by default. Set it before the first cycle.
  void setStateInterval(double seconds) { stateInterval_ = seconds; }

  /// Processes one cycle. All observations are recorded, also those that the filter does not use.
  void take(const mrpt::obs::CSensoryFrame::Ptr& cycle);
  /// Saves map and session to a dated subfolder after the next scan.
  void requestSave() { run_.requestSave(); }
  /// Returns the filter as it is now: for use before the first cycle and after `finish`, between which
  /// another thread has it.
  const FilterView& view() const { return run_.view(); }
  /// Returns whether the filter has failed; further cycles are useless then.
  bool hasFailed() const { return hasFailed_; }
  /// Returns the last verdict on the map so far; null before the first. For the watcher.
  std::shared_ptr<const run::Verdict> verdict() const { return verdict_; }

  /// Filters the waiting readings, of those after `patience` the newest, then writes all results; if the
  /// recording cannot be read (full disk), those that do not need it.
  /// @param lost      number of lost cycles, for metrics.json
  /// @param patience  s, for the waiting readings; empty: as long as they take
  /// @return the summary and the verdict, a line each
  /// @throws std::runtime_error if there was no scan; after the results have been written, with the filter's
  ///         failure, or if the recording lacks scans
  std::string finish(size_t lost, std::optional<double> patience = {});

  std::string recording() const { return recording_.path(); }  ///< the rawlog of this run
  size_t skipped() const { return skipped_; }

 private:
  using Clock = std::chrono::steady_clock;

  void takeObservation(const mrpt::obs::CObservation::Ptr& observation, Clock::time_point arrival);
  /// Reports once for each laser whether it is used.
  void reportUse(const mrpt::obs::CObservation2DRangeScan& scan);
  void filter();
  void stopFilter(Clock::time_point deadline);
  void tellSkipped();
  void tellNotes();
  void tellState();
  void tellVerdict();
  /// Names the last observation in the recording.
  std::string place() const;

  readings::ReadingAssembler assembler_;
  run::Configuration& configuration_;
  EventLog& log_;
  bool isQuiet_;
  bool hasWrongOdometry_ = false;  ///< a reading was not a number
  std::atomic<bool> hasFailed_{false};
  Watcher watcher_;
  run::FilterRun run_;
  Recording recording_;
  std::set<std::string> used_, ignored_;  ///< labels of lasers whose scans are used, and are not
  ReadingQueue queue_;
  std::vector<double> latencies_;  ///< ms, of each filtered scan
  Clock::time_point lastState_ = Clock::now();
  double stateInterval_ = 10;  ///< s
  run::RunningVerdict mapSoFar_;
  std::shared_ptr<const run::Verdict> verdict_;
  std::future<run::Verdict> nextVerdict_;
  size_t judged_ = 0;  ///< updates of the next verdict
  std::atomic<size_t> skipped_{0};
  size_t toldSkipped_ = 0;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace hybrid_slam::live
