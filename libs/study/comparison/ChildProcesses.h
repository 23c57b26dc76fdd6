/// @file ChildProcesses.h
/// @brief Commands side by side, each a process of its own.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hybrid_slam::comparison {

struct Command {
  std::vector<std::string> arguments;  ///< the program first; found along PATH if it has no slash
  std::filesystem::path messages;      ///< takes its standard error; standard output goes nowhere
};

/// How a command ended: an empty text for exit 0, else its last error message, or how it ended, or that
/// this is not known.
using CommandEnd = std::function<void(size_t command, const std::string& error)>;

/// Runs all commands in their order, at most `atOnce` at a time; `onStart` before each, `onEnd` after each.
/// Children are out of the terminal's reach (Ctrl-C is for the caller to handle) and do not outlive it.
/// @param stop  set from outside: the children that run are ended, and `onEnd` is not called for them
/// @returns whether all were run
bool runCommands(const std::vector<Command>& commands, size_t atOnce, const std::atomic<bool>& stop,
                 const std::function<void(size_t)>& onStart, const CommandEnd& onEnd);

}  // namespace hybrid_slam::comparison
