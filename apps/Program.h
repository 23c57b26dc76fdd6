/// @file Program.h
/// @brief Shared by all programs: the command line, one-line errors and exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <iostream>
#include <optional>
#include <string>

#include "base/Errors.h"

namespace hybrid_slam {

/// Prints the error on one line of standard error, even if it quotes text with line breaks. CMake defines
/// HYBRID_SLAM_PROGRAM, the program's name.
/// @return the exit code
inline int fail(int code, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << HYBRID_SLAM_PROGRAM ": error: " << message << "\n";
  return code;
}

/// Reads the command line.
/// @return the exit code if the program ends here (--help, --version)
/// @throws InputError for a wrong command line
inline std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return {};
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    throw InputError(error.what(), "command line", "see " HYBRID_SLAM_PROGRAM " --help");
  }
}

/// Runs a program's work. Exit code 2: wrong input; 1: any other exception.
/// @param words  message for any other exception
inline int exitCodeOf(const std::function<int()>& work,
                      const std::function<std::string(const std::exception&)>& words = messageOf) {
  try {
    return work();
  } catch (const InputError& error) {
    return fail(2, error.what());
  } catch (const std::exception& error) {
    return fail(1, words(error));
  }
}

/// Message for a failed run, identified by its INI file or log.
inline std::string runFailed(const std::string& file, const std::exception& error) {
  return "run failed: " + file + "; " + messageOf(error);
}

}  // namespace hybrid_slam
