/// @file NoiseStream.h
/// @brief The random streams of a simulation: one per seed, session, source and reading.
#pragma once

#include "base/RandomStream.h"

namespace hybrid_slam::simulation {

/// What the noise is of. Each has its own random streams.
enum class NoiseSource : uint64_t { laser = 1, odometry = 2, doors = 3, boxes = 4 };

/// @param session  1 or more
/// @param index    number of the reading, the door or the box
inline RandomStream noiseStream(uint64_t seed, uint64_t session, NoiseSource source, uint64_t index) {
  constexpr uint64_t kSourcesOfSession = 16;
  return {seed, index, (session - 1) * kSourcesOfSession + static_cast<uint64_t>(source)};
}

}  // namespace hybrid_slam::simulation
