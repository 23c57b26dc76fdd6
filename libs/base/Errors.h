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

/// The message of an exception in one line. MRPT's tell their call stack too, over several lines.
inline std::string messageOf(const std::exception& exception) {
  const std::string text = exception.what(), head = "Message: ";
  const size_t labelled = text.find(head), start = labelled == std::string::npos ? 0 : labelled + head.size();
  const size_t begin = text.find_first_not_of(" \n", start);
  return begin == std::string::npos ? "no message" : text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace hybrid_slam
