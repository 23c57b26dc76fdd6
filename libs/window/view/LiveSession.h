/// @file LiveSession.h
/// @brief A live run from an observation-server, for a window.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "live/EventLog.h"
#include "live/LiveOptions.h"
#include "window/view/FilterSnapshot.h"
#include "window/view/Published.h"

namespace hybrid_slam::window {

/// What a window shows of a live run.
struct LiveSnapshot {
  enum class State { running, finishing, done, failed };
  State state = State::running;
  bool isConnected = false;
  size_t scans = 0;
  std::vector<std::string> events;               ///< of the connection and the filter, one line each
  std::string message;                           ///< summary of the run, or why it failed
  std::string recording;                         ///< rawlog of the finished run
  std::shared_ptr<const FilterSnapshot> filter;  ///< null before the first update
};

/// Runs like hybrid-slam-live in two threads: one receives cycles, the other filters. Recording and results
/// go to the configuration's folder.
class LiveSession {
 public:
  /// @param server  HOST:PORT @throws InputError if malformed
  LiveSession(const run::Configuration& configuration, const live::LiveOptions& options,
              const std::string& server);
  /// Stops and waits for the results.
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  /// Ends the run; the state becomes done after the results are written.
  void stop() { isStopping_ = true; }
  /// Ends the run and waits until its results are written.
  void finish();
  /// Saves map and session to a dated subfolder after the next scan; an event names it.
  void saveMap() { wantsSave_ = true; }
  std::shared_ptr<const LiveSnapshot> snapshot() const { return snapshot_.get(); }

 private:
  void work();
  std::string run();

  run::Configuration configuration_;
  live::LiveOptions options_;
  std::pair<std::string, uint16_t> server_;
  live::EventLog log_;
  std::atomic<bool> isStopping_{false}, wantsSave_{false};
  Published<LiveSnapshot> snapshot_;
  std::thread thread_;
};

}  // namespace hybrid_slam::window
