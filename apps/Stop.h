/// @file Stop.h
/// @brief Ctrl-C: the first shuts the program down cleanly, the second kills it.
#pragma once

#include <time.h>

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

/// Makes the first stop signal set `stop`. One that comes half a second later or more has its default action.
/// Those before belong to the first: `timeout`, supervisors and closing terminals signal a process and then
/// its group.
inline void stopOnSignals() {
  onStopSignals([](int signal) {
    static std::atomic<long> first{-1};  // ms
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    const long now = time.tv_sec * 1000 + time.tv_nsec / 1000000;
    long earlier = -1;
    if (first.compare_exchange_strong(earlier, now)) stop = true;
    if (earlier < 0 || now - earlier < 500) return;
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  });
}

}  // namespace hybrid_slam
