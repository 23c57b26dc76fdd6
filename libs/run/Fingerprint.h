/// @file Fingerprint.h
/// @brief Tells whether two logs begin with the same readings.
#pragma once

#include <cstdint>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::run {

/// CRC-32 of all readings so far: times and ranges. A recording grows, so that the checksum of its file would
/// not do.
/// @param before  that of the readings before; 0 for the first
uint32_t fingerprintAfter(uint32_t before, const readings::Reading& reading);

}  // namespace hybrid_slam::run
