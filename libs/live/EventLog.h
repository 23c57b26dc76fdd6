/// @file EventLog.h
/// @brief Log of sensor and connection events, one line each.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace hybrid_slam::live {

/// Thread-safe. Repeated identical events of a subject (a sensor, the server), such as a refused connection
/// at each attempt, are logged once, until another event of that subject. Memory is bounded: after 1000
/// subjects, repeated events are logged again.
class EventLog {
 public:
  using Write = std::function<void(const std::string& line)>;

  /// Writes lines `PROGRAM: SUBJECT: EVENT` to standard error.
  explicit EventLog(const std::string& program);
  /// Passes these lines to `write` instead, for tests. One thread at a time calls it.
  EventLog(const std::string& program, Write write) : program_(program), write_(std::move(write)) {}

  void report(const std::string& subject, const std::string& event);

 private:
  std::string program_;
  Write write_;
  std::mutex mutex_;
  std::map<std::string, std::string> last_;  ///< event per subject
};

}  // namespace hybrid_slam::live
