/// @file ReplaySession.h
/// @brief A rawlog through two filters in step, in a thread of its own, under a player's buttons.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "run/Configuration.h"
#include "window/view/FilterSnapshot.h"

namespace hybrid_slam::window {

/// Where a replay stands: never changed once it is published.
struct ReplaySnapshot {
  enum class State { loading, paused, playing, ended, failed };
  State state = State::loading;
  size_t scans = 0, total = 0;  ///< through the filters; of the log
  double time = 0;              ///< s, from the first scan
  size_t run = 0;               ///< counts the starts from the log's beginning
  std::string message;          ///< one line: what failed, or what an export came to
  bool isError = false;         ///< the message is one of a failure
  size_t messages = 0;          ///< counts them, so that each is shown once
  std::vector<std::shared_ptr<const FilterSnapshot>> filters;  ///< one for each method; null before a scan
};

/// All calls return at once; what they ask for is done by the session's thread between two scans.
class ReplaySession {
 public:
  using Method = run::RunOptions::Method;

  /// Starts to read configuration.run.rawlog, and stands before its first scan.
  /// @param methods  one filter for each, with the same settings but for the lines
  ReplaySession(const run::Configuration& configuration, const std::vector<Method>& methods);
  /// Waits for the scan that is being processed, or the results that are being written.
  ~ReplaySession();
  ReplaySession(const ReplaySession&) = delete;
  ReplaySession& operator=(const ReplaySession&) = delete;

  void play();
  void pause();
  /// One scan on, then paused.
  void step();
  /// Runs to just after the scan of this number (from 1) as fast as it can, then paused; a scan that is
  /// passed already is reached by starting anew, which gives the same maps. 0: before the first scan.
  void seek(size_t scan);
  /// @param factor  of the log's own pace; 0: as fast as the filters go
  void setSpeed(double factor);
  /// Writes the results of doc/results.md to folder/METHOD as if the log ended here, with a note in the
  /// snapshot; the replay has then ended, and goes on from its start only.
  void exportResults(const std::string& folder);

  std::shared_ptr<const ReplaySnapshot> snapshot() const;

 private:
  struct Pass;
  enum class Goal { pause, play, reach };
  void work();
  void runPass();
  bool hasWork(Pass& pass);
  bool waitUntilDue(std::unique_lock<std::mutex>& lock, Pass& pass);
  void advance(Pass& pass);
  void exportPass(Pass& pass, const std::string& folder);
  void publish(Pass& pass, ReplaySnapshot::State state, bool withMaps);
  void tell(const std::string& message, bool isError, ReplaySnapshot::State state);

  const run::Configuration configuration_;
  const std::vector<Method> methods_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  /// @name Guarded by mutex_
  /// @{
  Goal goal_ = Goal::pause;
  size_t target_ = 0;  ///< scan to reach
  double speed_ = 1;
  bool isClosing_ = false, wantsRestart_ = false;
  std::optional<std::string> exportTo_;
  std::shared_ptr<const ReplaySnapshot> snapshot_ = std::make_shared<ReplaySnapshot>();
  /// @}
  /// @name Of the session's thread
  /// @{
  std::optional<readings::RawlogSummary> log_;
  size_t runs_ = 0;
  /// @}
  std::thread thread_;
};

}  // namespace hybrid_slam::window
