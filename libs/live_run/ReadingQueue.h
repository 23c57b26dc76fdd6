/// @file ReadingQueue.h
/// @brief What waits for the filter, and which scans are skipped when it is late.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::live {

struct QueuedReading {
  readings::Reading reading;  ///< its motion is that since the scan that the filter had before
  size_t skipped = 0;         ///< scans before it that the filter does not get
  std::chrono::steady_clock::time_point arrival;
};

/// The rule: when more than `limit` scans wait, all but the newest are skipped, and the newest carries their
/// motion. So the filter is never later than it takes for `limit` scans, and never works through a backlog.
class ReadingQueue {
 public:
  explicit ReadingQueue(size_t limit) : limit_(limit) {}

  void push(const readings::Reading& reading, std::chrono::steady_clock::time_point arrival) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.push_back({reading, 0, arrival});
      if (waiting_.size() > limit_) keepNewest();
    }
    changed_.notify_one();
  }
  /// No more readings come.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      isClosed_ = true;
    }
    changed_.notify_all();
  }
  /// Waits for the next reading; nothing once the queue is closed and empty.
  std::optional<QueuedReading> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return isClosed_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    QueuedReading next = waiting_.front();
    waiting_.pop_front();
    return next;
  }

 private:
  void keepNewest() {
    QueuedReading newest = waiting_.back();
    mrpt::math::TPose2D motion;
    for (const QueuedReading& waiting : waiting_) motion = motion + waiting.reading.motion;
    newest.reading.motion = motion;
    newest.skipped = waiting_.size() - 1;
    for (const QueuedReading& waiting : waiting_) newest.skipped += waiting.skipped;
    waiting_.assign(1, newest);
  }

  size_t limit_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<QueuedReading> waiting_;
  bool isClosed_ = false;
};

}  // namespace hybrid_slam::live
