/// @file TestEvents.h
/// @brief For the tests: captured events.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "live/EventLog.h"
#include "testing/Happens.h"

namespace hybrid_slam::test {

/// Captures the lines of an EventLog.
class Events {
 public:
  live::EventLog& log() { return *log_; }
  std::shared_ptr<live::EventLog> shared() { return log_; }
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
  std::shared_ptr<live::EventLog> log_ =
      std::make_shared<live::EventLog>("test", [lines = lines_](const std::string& line) {
        const std::lock_guard<std::mutex> lock(lines->mutex);
        lines->all.push_back(line);
      });
};

}  // namespace hybrid_slam::test
