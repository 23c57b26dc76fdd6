/// @file RandomStream.h
/// @brief Random numbers without global state: one stream per (seed, step, particle).
#pragma once

#include <cmath>
#include <cstdint>

namespace hybrid_slam {

/// A separate stream for each (seed, step, particle): a run draws the same numbers for any number of threads
/// and any order of particles.
///
/// The generator is SplitMix64 (Steele, Lea, Flood 2014), a counter with a mixing function. It needs no
/// warm-up, and streams with mixed keys are uncorrelated.
class RandomStream {
 public:
  RandomStream(uint64_t seed, uint64_t step, uint64_t particle)
      : state_(mix(mix(mix(seed) ^ step) ^ (particle + 0x632be59bd9b4e019ULL))) {}

  uint64_t bits() { return mix(state_ += kGolden); }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// Standard normal (Box-Muller).
  double gaussian() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * M_PI * uniform());
  }

 private:
  static constexpr uint64_t kGolden = 0x9e3779b97f4a7c15ULL;
  static uint64_t mix(uint64_t z) {
    z += kGolden;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  uint64_t state_;
};

}  // namespace hybrid_slam
