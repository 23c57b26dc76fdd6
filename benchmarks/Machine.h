/// @file Machine.h
/// @brief Measured arithmetic and memory rates of this machine.
#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace hybrid_slam::bench {

/// Rates of one core.
struct Machine {
  double scalar = 0;  ///< scalar additions of doubles per ns, in eight independent chains
  double sse = 0;     ///< the same with SSE2, two doubles per instruction; the project is built for SSE2
  double l1 = 0, l2 = 0, l3 = 0, memory = 0;  ///< bandwidth (B/ns) of a triad whose three arrays take 24 kB,
                                              ///< 512 kB, 8 MB and 192 MB in all
};

/// The fastest of several runs: other programs can only slow a run down.
template <class Work>
double shortestNs(int runs, const Work& work) {
  double best = 1e300;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(
        best, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

/// STREAM's triad, a[i] = b[i] + s c[i], in B/ns: two arrays read, one written.
inline double triad(size_t bytes) {
  const size_t n = bytes / 3 / sizeof(double);
  std::vector<double> a(n, 0), b(n, 1), c(n, 2);
  const int passes = static_cast<int>(std::max<size_t>(1, (size_t{4} << 20) / bytes));
  const double ns = shortestNs(30, [&] {
    for (int pass = 0; pass < passes; ++pass) {
      for (size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
      asm volatile("" : : "r"(a.data()) : "memory");
    }
  });
  return static_cast<double>(passes) * static_cast<double>(3 * n * sizeof(double)) / ns;
}

/// Additions per ns. Register is double or __m128d; `add` performs one addition.
template <class Register, class Add>
double additions(Register zero, int width, const Add& add) {
  constexpr int kRounds = 100000;
  Register r0 = zero, r1 = zero, r2 = zero, r3 = zero, r4 = zero, r5 = zero, r6 = zero, r7 = zero;
  const double ns = shortestNs(30, [&] {
    for (int i = 0; i < kRounds; ++i) {
      r0 = add(r0), r1 = add(r1), r2 = add(r2), r3 = add(r3);
      r4 = add(r4), r5 = add(r5), r6 = add(r6), r7 = add(r7);
      asm volatile("" : "+x"(r0), "+x"(r1), "+x"(r2), "+x"(r3), "+x"(r4), "+x"(r5), "+x"(r6), "+x"(r7));
    }
  });
  return 8.0 * kRounds * width / ns;
}

inline Machine measureMachine() {
  Machine m;
  m.scalar = additions(0.0, 1, [](double r) { return r + 1.0; });
  const __m128d one = _mm_set1_pd(1);
  m.sse = additions(_mm_setzero_pd(), 2, [one](__m128d r) { return _mm_add_pd(r, one); });
  m.l1 = triad(24 << 10);
  m.l2 = triad(512 << 10);
  m.l3 = triad(8 << 20);
  m.memory = triad(192 << 20);
  return m;
}

}  // namespace hybrid_slam::bench
