/// @file Stop.h
/// @brief Ctrl-C: the first shuts the program down cleanly, the second kills it.
#pragma once

#include <atomic>
#include <csignal>

namespace hybrid_slam {

/// True once the user has asked to stop. Global because a signal handler can reach nothing else.
inline std::atomic<bool> stop{false};

/// Calls `handle` on SIGINT, SIGTERM and SIGHUP (the terminal closes; not under nohup).
inline void onStopSignals(void (*handle)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, handle) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);
}

/// Makes the first stop signal set `stop`. The next one has its default action.
inline void stopOnSignals() {
  onStopSignals([](int signal) {
    stop = true;
    std::signal(signal, SIG_DFL);
  });
}

}  // namespace hybrid_slam
