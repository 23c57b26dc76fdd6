#include "live/EventLog.h"

#include <cstdio>

namespace hybrid_slam::live {

EventLog::EventLog(const std::string& program)
    : EventLog(program, [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }) {}

void EventLog::report(const std::string& subject, const std::string& event) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string& last = last_[subject];
  if (last == event) return;
  last = event;
  write_(program_ + ": " + subject + ": " + event);
}

}  // namespace hybrid_slam::live
