/// @file SaveSignal.h
/// @brief SIGUSR1: save the map now.
#pragma once

#include <csignal>
#include <ctime>

namespace hybrid_slam {

inline sigset_t saveSignal() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  return set;
}

/// Blocks the signal. Call before threads are started: they inherit the mask, so the signal interrupts no
/// driver.
inline void holdSaveSignal() {
  const sigset_t set = saveSignal();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

/// Returns whether the signal was received since the last call.
inline bool takeSaveSignal() {
  const sigset_t set = saveSignal();
  const timespec now{};
  return sigtimedwait(&set, nullptr, &now) == SIGUSR1;
}

}  // namespace hybrid_slam
