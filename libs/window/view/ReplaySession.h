/// @file ReplaySession.h
/// @brief Replays a log through two filters in lockstep, in a separate thread, with player controls.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "run/LogSettings.h"
#include "window/view/Checkpoints.h"
#include "window/view/Published.h"

namespace hybrid_slam::window {

struct ReplayPass;

/// Immutable state of a replay.
struct ReplaySnapshot {
  enum class State { loading, paused, playing, ended, failed };
  State state = State::loading;
  size_t scans = 0, total = 0;  ///< processed; in the log
  double time = 0;              ///< s, from the first scan
  size_t run = 0;               ///< number of starts from the beginning of the log
  std::string message;          ///< one line: an error, or the result of an export
  bool isError = false;         ///< the message is an error
  std::string note;             ///< one line, shown last: a warning on the log, the map saved, a loop closed
  std::vector<std::string> events;  ///< one line each: lasers, settings derived from the log, all notes
  size_t messages = 0;              ///< number of messages, so that each is shown once
  std::shared_ptr<const run::LogSettings> ofLog;               ///< null until the log has been read
  std::vector<std::shared_ptr<const FilterSnapshot>> filters;  ///< one per method; null before the first scan
};

/// All calls return immediately; the session's thread executes them between scans.
class ReplaySession {
 public:
  using Method = run::RunOptions::Method;

  /// Starts reading configuration.run.rawlog; paused before the first scan.
  /// @param methods  one filter each, with the same settings except for the maps
  ReplaySession(const run::Configuration& configuration, const std::vector<Method>& methods);
  /// Waits for the current scan or export to finish.
  ~ReplaySession();
  ReplaySession(const ReplaySession&) = delete;
  ReplaySession& operator=(const ReplaySession&) = delete;

  void play();
  void pause();
  void playOrPause();
  /// Moves one scan forward, then pauses.
  void step();
  /// Moves one scan back, then pauses.
  void stepBack();
  /// Runs at full speed until just after this scan (from 1; 0: before the first), then pauses. Going back
  /// resumes from the nearest earlier checkpoint or restarts the replay; both give the same maps.
  void seek(size_t scan);
  /// @param factor  of real time; 0: as fast as possible
  void setSpeed(double factor);
  /// Writes the results of doc/results.md to folder/METHOD as if the log ended here, with a message in the
  /// snapshot. This ends the replay; it can only be restarted.
  void exportResults(const std::string& folder);

  /// Writes the current map, trajectory and session to folder/METHOD, or to a dated subfolder if that exists,
  /// with a message in the snapshot. The replay continues.
  void saveMap(const std::string& folder);

  std::shared_ptr<const ReplaySnapshot> snapshot() const { return snapshot_.get(); }

 private:
  enum class Goal { pause, play, reach };
  /// @name With mutex_ locked
  /// @{
  void startPlaying();
  void reach(size_t scan);
  size_t goingTo() const;
  void restartFrom(size_t scan);
  bool mustJump(const ReplayPass& pass) const;
  /// @}
  void work();
  void runPass();
  void readLog();
  bool hasWork(ReplayPass& pass);
  bool waitUntilDue(std::unique_lock<std::mutex>& lock, ReplayPass& pass);
  void advance(ReplayPass& pass);
  void exportPass(ReplayPass& pass, const std::string& folder);
  void savePass(ReplayPass& pass, const std::string& folder);
  void event(const std::string& text);
  void note(const std::string& text);
  void publish(ReplayPass& pass, ReplaySnapshot::State state, bool withMaps);
  void tell(const std::string& message, bool isError, ReplaySnapshot::State state);

  run::Configuration configuration_;  ///< of the thread; with the settings derived from the log
  const std::vector<Method> methods_;

  std::mutex mutex_;
  std::condition_variable wake_;
  /// @name Guarded by mutex_
  /// @{
  Goal goal_ = Goal::pause;
  size_t target_ = 0;     ///< scan to reach
  size_t scans_ = 0;      ///< processed; the snapshot may be older
  size_t restartAt_ = 0;  ///< scan that the next pass is to reach
  double speed_ = 1;
  bool isClosing_ = false, wantsRestart_ = false;
  std::optional<std::string> exportTo_, saveTo_;
  /// @}
  Published<ReplaySnapshot> snapshot_;
  /// @name Used by the session's thread only
  /// @{
  std::optional<readings::RawlogSummary> log_;
  Checkpoints checkpoints_;
  size_t runs_ = 0;
  /// @}
  std::thread thread_;
};

/// Returns the methods to show side by side: hybrid and the configured one, or general if that is also
/// hybrid.
std::vector<run::RunOptions::Method> comparedMethods(const run::Configuration& configuration);

}  // namespace hybrid_slam::window
