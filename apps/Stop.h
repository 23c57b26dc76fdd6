/// @file Stop.h
/// @brief Ctrl-C: the first ends a program in good order, the second at once.
#pragma once

#include <atomic>
#include <csignal>

namespace hybrid_slam {

/// Whether the user has asked for the end. A handler of signals reaches nothing but a global.
inline std::atomic<bool> stop{false};

/// From here on SIGINT and SIGTERM set `stop`, each once.
inline void stopOnSignals() {
  const auto onSignal = [](int signal) {
    stop = true;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

}  // namespace hybrid_slam
