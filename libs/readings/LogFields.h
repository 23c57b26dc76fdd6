/// @file LogFields.h
/// @brief The blank-separated fields of one line of a log, taken one after the other.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hybrid_slam::readings {

/// A line that does not hold what its record type asks for; what() says why.
struct BrokenLine : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Every getter takes the next field and throws BrokenLine where the field is not what it asks for.
class LogFields {
 public:
  explicit LogFields(std::string_view line);

  bool empty() const { return next_ == fields_.size(); }
  size_t left() const { return fields_.size() - next_; }
  /// @throws BrokenLine unless exactly `count` fields are left; `what` describes them
  void expectLeft(size_t count, const std::string& what) const;

  std::string_view word();
  void skip(size_t count) { next_ += count; }
  /// A finite number.
  double number();
  /// A range reading (m): a number, of which `nan` and `inf` are a laser's ways to say "nothing seen".
  float range();
  /// A whole number from `least` on.
  size_t count(size_t least);
  /// A time in seconds that a timestamp can hold.
  double time();
  /// x, y (m), theta (rad).
  mrpt::math::TPose2D pose();

 private:
  double anyNumber();
  std::vector<std::string_view> fields_;
  size_t next_ = 0;
};

/// The field in backquotes, shortened, with a `?` for what cannot be printed.
std::string inBackquotes(std::string_view field);

}  // namespace hybrid_slam::readings
