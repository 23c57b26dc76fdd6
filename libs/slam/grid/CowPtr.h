/// @file CowPtr.h
/// @brief A value shared between copies until one of them writes.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace hybrid_slam {

/// Copying copies a pointer; `write` first makes this copy's value unshared. Threads may concurrently read
/// and write different CowPtrs that share a value.
template <class T>
class CowPtr {
 public:
  CowPtr() = default;
  explicit CowPtr(T value) : shared_(std::make_shared<T>(std::move(value))) {}

  explicit operator bool() const { return shared_ != nullptr; }
  const T* get() const { return shared_.get(); }
  const T& operator*() const { return *shared_; }
  const T* operator->() const { return shared_.get(); }
  /// Returns whether both share one value in memory.
  bool sharesWith(const CowPtr& other) const { return shared_ == other.shared_; }
  template <class State>
  void visit(State& state) {
    state(shared_);
  }

  /// Returns the value for writing, unshared; default-constructed if there was none.
  T& write() {
    if (!shared_) {
      shared_ = std::make_shared<T>();
    } else if (shared_.use_count() > 1) {
      shared_ = std::make_shared<T>(std::as_const(*shared_));
    } else {
      acquire();
    }
    return *shared_;
  }

 private:
  /// Synchronises with the last other owner, which may just have read the value on another thread.
  void acquire() const {
#ifdef __SANITIZE_THREAD__
    const std::shared_ptr<T> counted = shared_;  // the thread sanitizer understands this, but not fences
#else
    std::atomic_thread_fence(std::memory_order_acquire);
#endif
  }

  std::shared_ptr<T> shared_;
};

}  // namespace hybrid_slam
