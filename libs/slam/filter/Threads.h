/// @file Threads.h
/// @brief Loops on several threads.
#pragma once

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <thread>
#include <vector>
#endif

namespace hybrid_slam {

/// Returns the size of a task arena for `threads` of [particle_filter]; 0: all cores. Limited to the
/// machine's threads: TBB ignores more, with a warning on stderr.
inline int arenaThreads(int threads) {
  const auto allowed =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return threads > 0 ? std::min(threads, allowed) : +tbb::task_arena::automatic;
}

/// Calls body(i) for i in [first, last), on the threads of the arena and the caller's.
template <class Body>
void parallelFor(tbb::task_arena& arena, size_t first, size_t last, const Body& body) {
#ifdef __SANITIZE_THREAD__
  // The thread sanitizer would not see the order that TBB's library establishes.
  std::atomic<size_t> next{first};
  const auto work = [&] {
    for (size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < last;) body(i);
  };
  std::vector<std::thread> threads;
  for (int others = arena.max_concurrency() - 1; others > 0; --others) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
#else
  arena.execute([&] { tbb::parallel_for(first, last, body); });
#endif
}

}  // namespace hybrid_slam
