/// @file Published.h
/// @brief A value that threads change and others read at any time, as an immutable snapshot.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace hybrid_slam::window {

/// A value shared by threads.
template <class Snapshot>
class Published {
 public:
  std::shared_ptr<const Snapshot> get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return now_;
  }
  /// Publishes a copy of the snapshot after `edit`, which must not use this object.
  template <class Edit>
  void change(const Edit& edit) {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto next = std::make_shared<Snapshot>(*now_);
    edit(*next);
    now_ = std::move(next);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const Snapshot> now_ = std::make_shared<Snapshot>();
};

}  // namespace hybrid_slam::window
