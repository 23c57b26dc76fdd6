/// @file ChildProcesses.h
/// @brief Runs commands in parallel, each as a separate process.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hybrid_slam::comparison {

/// A command to run.
struct ChildCommand {
  std::vector<std::string> arguments;  ///< program first; searched in PATH if it has no slash
  std::filesystem::path messages;      ///< file for standard error; standard output is discarded
};

/// Result of a command: empty for exit 0, else its last error message or its exit status.
using CommandEnd = std::function<void(size_t command, const std::string& error)>;

/// Runs all commands in their order, at most `atOnce` at a time; `onStart` before each, `onEnd` after each.
/// Children do not receive the terminal's signals (the caller handles Ctrl-C) and do not outlive the caller.
/// @param stop  set from outside: running children are killed, without `onEnd`
/// @returns whether all commands ran
bool runCommands(const std::vector<ChildCommand>& commands, size_t atOnce, const std::atomic<bool>& stop,
                 const std::function<void(size_t)>& onStart, const CommandEnd& onEnd);

}  // namespace hybrid_slam::comparison
