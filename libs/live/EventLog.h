/// @file EventLog.h
/// @brief What happens to sensors and connections, one line for each event.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace hybrid_slam::live {

/// Takes events from any thread. A subject (a sensor, the server) that reports the same state again and
/// again, such as a refused connection at each attempt, is heard once; its next other state is heard anew.
class EventLog {
 public:
  using Write = std::function<void(const std::string& line)>;

  /// Lines `PROGRAM: SUBJECT: EVENT` to standard error.
  explicit EventLog(const std::string& program);
  /// The same to anywhere, for tests; called from one thread at a time.
  EventLog(const std::string& program, Write write) : program_(program), write_(std::move(write)) {}

  void report(const std::string& subject, const std::string& event);

 private:
  std::string program_;
  Write write_;
  std::mutex mutex_;
  std::map<std::string, std::string> last_;  ///< event of each subject
};

}  // namespace hybrid_slam::live
