/// @file Errors.h
/// @brief Errors the user can fix.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace hybrid_slam {

/// A wrong command line, INI file or input file. Programs print it on one line and exit with 2; any other
/// exception means a failed run (exit 1).
class InputError : public std::runtime_error {
 public:
  /// @param what      what is wrong: "unknown key `gap_absolut`"
  /// @param where     file, section, key, entry number
  /// @param expected  what was expected instead
  InputError(const std::string& what, const std::string& where, const std::string& expected)
      : std::runtime_error(visible(what + ": " + where + "; " + expected)) {}

 private:
  /// Writes zero bytes of a file as `\x00`: they would end the message.
  static std::string visible(std::string text);
};

/// Returns whether memory ran out, in our code or in MRPT's: a file that was being read is not to blame.
bool isOutOfMemory(const std::exception& exception);

/// The message of an exception on one line, without the code location and call stack that MRPT adds.
std::string messageOf(const std::exception& exception);

}  // namespace hybrid_slam
