/// @file Program.h
/// @brief What all programs do alike: command line in, exit code and one line of error out.
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

/// Says on standard error why the program ends, in one line whatever the user's words in it hold.
/// HYBRID_SLAM_PROGRAM is its name, from CMake.
/// @return the exit code
inline int fail(int code, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << HYBRID_SLAM_PROGRAM ": error: " << message << "\n";
  return code;
}

/// Reads the command line.
/// @return the exit code where the program ends with that: --help, --version
/// @throws InputError for a wrong one
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

/// Does a program's work: 2 is the exit code for a wrong input, 1 for every other exception.
/// @param words  what to say of such another exception
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

/// What to say of a run that failed, which is known by its INI file.
inline std::string runFailed(const std::string& config, const std::exception& error) {
  return "run failed: " + config + "; " + messageOf(error);
}

}  // namespace hybrid_slam
