/// @file ReadingQueue.h
/// @brief Queue of readings for the filter; skips scans if it is late.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::live {

/// A reading that waits for the filter.
struct QueuedReading {
  readings::Reading reading;  ///< its motion is since the previous filtered scan
  size_t skipped = 0;         ///< scans skipped before it
  std::chrono::steady_clock::time_point arrival;
};

/// If more than `limit` scans wait, all but the newest are skipped; the newest carries their motion. The
/// filter thus lags by at most the time for `limit` scans and never processes a backlog.
class ReadingQueue {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ReadingQueue(size_t limit) : limit_(limit) {}

  void push(const readings::Reading& reading, Clock::time_point arrival) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.push_back({reading, 0, arrival});
      if (waiting_.size() > limit_) keepNewest();
    }
    changed_.notify_one();
  }
  /// Announces the end of the readings. Of those that still wait at the deadline, only the newest is kept.
  void close(Clock::time_point deadline = Clock::time_point::max()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      isClosed_ = true;
      deadline_ = deadline;
    }
    changed_.notify_all();
  }
  /// Waits for the next reading; empty once the queue is closed and empty.
  std::optional<QueuedReading> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return isClosed_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    if (waiting_.size() > 1 && Clock::now() >= deadline_) keepNewest();
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
  Clock::time_point deadline_ = Clock::time_point::max();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<QueuedReading> waiting_;
  bool isClosed_ = false;
};

}  // namespace hybrid_slam::live
