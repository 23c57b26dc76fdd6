/// @file ByteCursor.h
/// @brief Reads numbers and strings from bytes of unknown origin, within their bounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hybrid_slam::bags {

/// Thrown for bytes without the expected layout; what() says what is wrong.
struct BrokenBytes : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown where a file ends before its content.
struct CutOff : BrokenBytes {
  CutOff() : BrokenBytes("cut off in the middle of a record") {}
};

/// A name of unknown origin without characters that control a terminal.
inline std::string printable(std::string_view name) {
  std::string text(name);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return text;
}

/// A position in a run of bytes. Each getter moves it and throws BrokenBytes beyond the end.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes, bool isBigEndian = false)
      : bytes_(bytes), isBigEndian_(isBigEndian) {}

  size_t left() const { return bytes_.size() - at_; }
  size_t at() const { return at_; }
  std::string_view take(size_t count) {
    if (count > left()) throw BrokenBytes("it ends too early");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  /// Reads an integer or floating-point number, stored without padding.
  template <class Number>
  Number number() {
    char bytes[sizeof(Number)];
    const std::string_view taken = take(sizeof(Number));
    for (size_t i = 0; i < sizeof(Number); ++i) bytes[i] = taken[isBigEndian_ ? sizeof(Number) - 1 - i : i];
    Number value;
    std::memcpy(&value, bytes, sizeof(Number));
    return value;
  }
  /// Reads a 32-bit length and that many bytes.
  std::string_view block() { return take(number<uint32_t>()); }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
  bool isBigEndian_;
};

}  // namespace hybrid_slam::bags
