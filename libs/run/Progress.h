/// @file Progress.h
/// @brief Progress of a run: a bar with the time left on a terminal, plain lines otherwise.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "run/TimeLeft.h"

namespace hybrid_slam::run {

/// Writes to standard error, at most five times per second on a terminal and every ten seconds otherwise.
class Progress {
 public:
  Progress(size_t total, bool isQuiet);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins where an earlier run ended; the time left is that of the others.
  void beginAt(size_t done);
  /// @param done  of `total`; @param note  shown next to it, such as the particles' spread
  void update(size_t done, const std::string& note);
  /// Writes a separate line, also if quiet.
  void say(const std::string& line);
  /// Ends the line of the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  size_t total_, first_ = 0;
  TimeLeft timeLeft_;
  bool isQuiet_, isTerminal_, hasBar_ = false;
  Clock::time_point start_, last_;
};

}  // namespace hybrid_slam::run
