/// @file Stop.h
/// @brief Ctrl-C: the first shuts the program down cleanly, the second kills it.
#pragma once

#include <atomic>
#include <csignal>

namespace hybrid_slam {

/// True once the user has asked to stop. Global because a signal handler can reach nothing else.
inline std::atomic<bool> stop{false};

/// SIGINT or SIGTERM sets `stop`; that signal then has its default action again.
inline void stopOnSignals() {
  const auto onSignal = [](int signal) {
    stop = true;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

}  // namespace hybrid_slam
