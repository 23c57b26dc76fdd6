/// @file Errors.h
/// @brief The one kind of error that is the user's to mend.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace hybrid_slam {

/// A wrong command line, INI file or input file: programs print it as one line and exit with 2.
/// Every other exception means that the run failed (exit 1).
class InputError : public std::runtime_error {
 public:
  /// @param what      what is wrong: "unknown key `gap_absolut`"
  /// @param where     file, section, key, entry number
  /// @param expected  what was expected instead
  InputError(const std::string& what, const std::string& where, const std::string& expected)
      : std::runtime_error(what + ": " + where + "; " + expected) {}
};

/// The message of an exception in one line. MRPT's tell their place in the code and their call stack too.
std::string messageOf(const std::exception& exception);

}  // namespace hybrid_slam
