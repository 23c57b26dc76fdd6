/// @file Stop.h
/// @brief Ctrl-C: the first shuts the program down cleanly, the second kills it.
#pragma once

#include <atomic>
#include <csignal>

namespace hybrid_slam {

/// True once the user has asked to stop. Global because a signal handler can reach nothing else.
inline std::atomic<bool> stop{false};

/// SIGINT, SIGTERM or SIGHUP (a terminal that closes) sets `stop`; that signal then has its default action
/// again.
inline void stopOnSignals() {
  const auto onSignal = [](int signal) {
    stop = true;
    std::signal(signal, SIG_DFL);
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, onSignal) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);  // nohup
}

}  // namespace hybrid_slam
