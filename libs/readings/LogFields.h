/// @file LogFields.h
/// @brief The blank-separated fields of a log line, read in sequence.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hybrid_slam::readings {

/// Thrown for a line that does not match its record type; what() gives the reason.
struct BrokenLine : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Every getter reads the next field and throws BrokenLine if it is invalid.
class LogFields {
 public:
  explicit LogFields(std::string_view line);

  bool empty() const { return next_ == fields_.size(); }
  size_t left() const { return fields_.size() - next_; }
  /// @throws BrokenLine unless exactly `count` fields are left; `what` describes them
  void expectLeft(size_t count, const std::string& what) const;
  /// Returns whether `count` fields, after the next `skipped` ones, exist and are `0`.
  bool isZero(size_t skipped, size_t count) const;

  std::string_view word();
  void skip(size_t count) { next_ += count; }
  /// Reads a finite number.
  double number();
  /// Reads a range (m); `nan` and `inf` mean no return.
  float range();
  /// Reads a whole number of at least `least`.
  size_t count(size_t least);
  /// Reads a time (s) within the range of a timestamp.
  double time();
  /// Reads x, y (m), theta (rad).
  mrpt::math::TPose2D pose();

 private:
  double anyNumber();
  std::vector<std::string_view> fields_;
  size_t next_ = 0;
};

/// Returns the field in backquotes, shortened, with `?` for unprintable characters.
std::string inBackquotes(std::string_view field);

}  // namespace hybrid_slam::readings
