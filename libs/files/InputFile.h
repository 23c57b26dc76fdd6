/// @file InputFile.h
/// @brief Checks a file before it is opened.
#pragma once

#include <string>

namespace hybrid_slam::files {

/// Opening a pipe waits for its writer, and a folder opens without an error.
/// @param expected  "expected a ..."
/// @throws InputError unless there is a regular file of this name
void expectFile(const std::string& path, const std::string& expected);

}  // namespace hybrid_slam::files
