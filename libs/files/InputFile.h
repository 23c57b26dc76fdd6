/// @file InputFile.h
/// @brief Checks a file before it is opened, and whether it has changed since.
#pragma once

#include <string>

namespace hybrid_slam::files {

/// Opening a pipe waits for its writer, and a folder opens without an error.
/// @param expected  "expected a ..."
/// @throws InputError unless there is a regular file of this name
void expectFile(const std::string& path, const std::string& expected);

/// Returns a text that changes when a file is replaced or written to: its device, number, size and time of
/// modification; of a folder, those of its files. Empty if there is none.
std::string stateOf(const std::string& path);

}  // namespace hybrid_slam::files
