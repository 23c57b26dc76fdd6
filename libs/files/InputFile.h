/// @file InputFile.h
/// @brief Checks a file before it is opened, and whether it has changed since.
#pragma once

#include <functional>
#include <string>

namespace hybrid_slam::files {

/// Opening a pipe waits for its writer, and a folder opens without an error.
/// @param expected  "expected a ..."
/// @throws InputError unless there is a regular file of this name
void expectFile(const std::string& path, const std::string& expected);

/// Files that a program may replace are of the kind that it writes; others may be the user's, such as the
/// second log of `log2rawlog *.clf`.
/// @param kind  "rawlog"
/// @throws InputError if the path is a file with content that is of another kind
void expectReplaceable(const std::string& path, const std::string& kind,
                       const std::function<bool(const std::string&)>& isOfKind);

/// Returns a text that changes when a file is replaced or written to: its device, number, size and time of
/// modification; of a folder, those of the recording in it. Empty if there is none.
std::string stateOf(const std::string& path);

}  // namespace hybrid_slam::files
