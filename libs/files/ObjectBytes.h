/// @file ObjectBytes.h
/// @brief The bytes of a stream of serialised objects, read only as far as needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace hybrid_slam::files {

/// A window on a stream, from the start of the current object. Memory grows with the bytes in the stream, not
/// with the lengths that they claim.
class ObjectBytes {
 public:
  /// Writes at most `count` bytes to `to` and returns how many; 0: the stream has ended.
  using Source = std::function<size_t(char* to, size_t count)>;

  explicit ObjectBytes(Source source) : source_(std::move(source)) {}
  explicit ObjectBytes(std::string whole) : bytes_(std::move(whole)), last_(bytes_.size()) {}

  /// Reads on as needed; returns whether the bytes [0, end) exist.
  bool has(size_t end) {
    while (last_ - first_ < end)
      if (!readMore()) return false;
    return true;
  }
  /// @param i  less than an `end` that exists
  uint8_t operator[](size_t i) const { return static_cast<uint8_t>(bytes_[first_ + i]); }
  char& at(size_t i) { return bytes_[first_ + i]; }
  /// Valid until the next `has`.
  std::string_view view(size_t at, size_t count) const { return {bytes_.data() + first_ + at, count}; }
  /// Moves the start of the window.
  void drop(size_t count) { first_ += count; }

 private:
  bool readMore() {
    constexpr size_t kStep = 8192;
    if (!source_) return false;
    if (first_ >= kStep) {
      std::memmove(&bytes_[0], &bytes_[first_], last_ - first_);
      last_ -= first_;
      first_ = 0;
    }
    if (bytes_.size() < last_ + kStep) bytes_.resize(2 * last_ + kStep);
    const size_t count = source_(&bytes_[last_], kStep);
    last_ += count;
    return count > 0;
  }

  Source source_;
  std::string bytes_;  ///< valid: [first_, last_)
  size_t first_ = 0, last_ = 0;
};

}  // namespace hybrid_slam::files
