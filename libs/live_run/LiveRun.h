/// @file LiveRun.h
/// @brief Cycles of observations into a recording, through the filter, into results.
#pragma once

#include <atomic>
#include <deque>
#include <exception>
#include <functional>
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

namespace hybrid_slam::live {

/// The caller's thread records and pairs, a thread of its own filters. Replaying the recording by hybrid-slam
/// gives the same readings, and where none was skipped the same results, to the byte.
class LiveRun {
 public:
  /// @param configuration  with [live] among its sections; outlives the run
  /// @param isQuiet        no line about the filter's state every 10 s
  /// @throws InputError for wrong settings, or an output folder that cannot be written to
  LiveRun(run::Configuration& configuration, const LiveOptions& options, EventLog& log, bool isQuiet);
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// Called in the filter's thread after each scan with whether the filter was updated; to be set before the
  /// first cycle.
  using Watcher = std::function<void(const FilterView&, const readings::Reading&, bool isUpdate)>;
  void setWatcher(Watcher watcher) { watcher_ = std::move(watcher); }

  /// One cycle. Odometry that is not a number, and where the input requires odometry all but the last few
  /// observations before the first odometry, are left out, also of the recording.
  void take(const mrpt::obs::CSensoryFrame::Ptr& cycle);
  /// The filter gave up: there is no use in more cycles.
  bool hasFailed() const { return hasFailed_; }

  /// The filter takes what waits; then all results are written.
  /// @param lost  cycles that did not reach the run; to metrics.json
  /// @return one line: what the run came to
  /// @throws std::runtime_error if no scan came, or what made the filter fail; the recording is there anyway
  std::string finish(const std::string& version, size_t lost);

  size_t skipped() const { return skipped_; }

 private:
  using Clock = std::chrono::steady_clock;

  using Arrived = std::pair<mrpt::obs::CObservation::Ptr, Clock::time_point>;

  void takeObservation(const mrpt::obs::CObservation::Ptr& observation, Clock::time_point arrival);
  void pass(const Arrived& arrived);
  void filter();
  void stopFilter();
  void tellState();

  run::Configuration& configuration_;
  EventLog& log_;
  bool isQuiet_;
  Watcher watcher_;
  run::FilterRun run_;
  Recording recording_;
  std::set<std::string> ignored_;  ///< labels of lasers whose scans are not used
  readings::ReadingAssembler assembler_;
  ReadingQueue queue_;
  bool hasOdometry_ = false;
  std::deque<Arrived> early_;      ///< before the first odometry
  std::vector<double> latencies_;  ///< ms, of each scan that was filtered
  Clock::time_point lastState_ = Clock::now();
  std::atomic<size_t> skipped_{0};
  std::atomic<bool> hasFailed_{false};
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace hybrid_slam::live
