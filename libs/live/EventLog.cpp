#include "live/EventLog.h"

#include <cstdio>

#include "base/Terminal.h"

namespace hybrid_slam::live {
namespace {

constexpr size_t kMostSubjects = 1000;

}  // namespace

EventLog::EventLog(const std::string& program)
    : EventLog(program, [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }) {}

void EventLog::report(const std::string& subject, const std::string& event) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_.size() >= kMostSubjects) last_.clear();  // each connection of a client is one
  std::string& last = last_[subject];
  if (last == event) return;
  last = event;
  write_(onOneLine(program_ + ": " + subject + ": " + event));
}

}  // namespace hybrid_slam::live
