/// @file TestEvents.h
/// @brief For the tests: events that can be looked at, and waiting for what other threads do.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "live/EventLog.h"

namespace hybrid_slam::test {

/// An EventLog's lines.
class Events {
 public:
  EventLog& log() { return *log_; }
  std::shared_ptr<EventLog> shared() { return log_; }
  size_t count(const std::string& part) const {
    const std::lock_guard<std::mutex> lock(lines_->mutex);
    size_t found = 0;
    for (const std::string& line : lines_->all) found += line.find(part) != std::string::npos ? 1 : 0;
    return found;
  }
  std::string text() const {
    const std::lock_guard<std::mutex> lock(lines_->mutex);
    std::string all;
    for (const std::string& line : lines_->all) all += line + "\n";
    return all;
  }

 private:
  struct Lines {
    std::mutex mutex;
    std::vector<std::string> all;
  };
  std::shared_ptr<Lines> lines_ = std::make_shared<Lines>();
  std::shared_ptr<EventLog> log_ =
      std::make_shared<EventLog>("test", [lines = lines_](const std::string& line) {
        const std::lock_guard<std::mutex> lock(lines->mutex);
        lines->all.push_back(line);
      });
};

/// Waits for a condition; a minute is for machines that are busy, not for what is being waited for.
inline bool happens(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace hybrid_slam::test
