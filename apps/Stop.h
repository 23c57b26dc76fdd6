/// @file Stop.h
/// @brief Ctrl-C: the first shuts the program down cleanly, the second kills it.
#pragma once

#include <time.h>

#include <atomic>
#include <csignal>
#include <cstdint>

namespace hybrid_slam {

/// True once the user has asked to stop. Global because a signal handler can reach nothing else.
inline std::atomic<bool> stop{false};

/// Makes the first of SIGINT, SIGTERM and SIGHUP (the terminal closes; not under nohup) set `stop`. One that
/// comes half a second later or more has its default action. Those before belong to the first: `timeout`,
/// supervisors and closing terminals signal a process and then its group. A later SIGHUP is ignored: the
/// terminal may close while results are written.
inline void stopOnSignals() {
  const auto handle = [](int signal) {
    constexpr std::int64_t kNone = -1;
    static std::atomic<std::int64_t> first{kNone};  // ms
    static_assert(std::atomic<std::int64_t>::is_always_lock_free, "for signal handlers");
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    const std::int64_t now = std::int64_t{time.tv_sec} * 1000 + time.tv_nsec / 1000000;
    std::int64_t earlier = kNone;
    if (first.compare_exchange_strong(earlier, now)) stop = true;
    if (earlier == kNone || signal == SIGHUP || now - earlier < 500) return;
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, handle) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);
}

}  // namespace hybrid_slam
