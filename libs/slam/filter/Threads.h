/// @file Threads.h
/// @brief Loops on several threads.
#pragma once

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace hybrid_slam {

/// For `threads` of [particle_filter]; 0: all cores. Limited to the machine's threads: TBB ignores more, with
/// a warning on stderr.
inline int arenaThreads(int threads) {
  const auto allowed =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return threads > 0 ? std::min(threads, allowed) : +tbb::task_arena::automatic;
}

/// The order that TBB establishes, told to the thread sanitizer, which does not see into TBB's library:
/// `release` happens before every later `acquire`.
class LoopOrder {
 public:
#ifdef __SANITIZE_THREAD__
  void release() { __tsan_release(this); }
  void acquire() { __tsan_acquire(this); }
#else
  void release() {}
  void acquire() {}
#endif
};

/// body(i) for i in [first, last), on the threads of the arena.
template <class Body>
void parallelFor(tbb::task_arena& arena, size_t first, size_t last, const Body& body) {
  LoopOrder begin, end;
  begin.release();
  arena.execute([&] {
    tbb::parallel_for(first, last, [&](size_t i) {
      begin.acquire();
      body(i);
      end.release();
    });
  });
  end.acquire();
}

}  // namespace hybrid_slam
