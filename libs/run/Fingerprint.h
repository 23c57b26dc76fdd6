/// @file Fingerprint.h
/// @brief Detects whether two logs begin with the same readings.
#pragma once

#include <cstdint>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::run {

/// CRC-32 of the times and ranges of all readings so far. The checksum of a recording's file would change as
/// it grows.
/// @param before  fingerprint of the previous readings; 0 for the first
uint32_t fingerprintAfter(uint32_t before, const readings::Reading& reading);

}  // namespace hybrid_slam::run
