/// @file Threads.h
/// @brief Number of threads of a task arena.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace hybrid_slam {

/// For `threads` of [particle_filter]; 0: all cores. Limited to the machine's threads: TBB ignores more, with
/// a warning on stderr.
inline int arenaThreads(int threads) {
  const auto allowed =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return threads > 0 ? std::min(threads, allowed) : +tbb::task_arena::automatic;
}

}  // namespace hybrid_slam
