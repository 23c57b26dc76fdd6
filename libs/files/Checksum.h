/// @file Checksum.h
/// @brief The checksum of a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hybrid_slam::files {

/// CRC-32 of the content; empty if the file cannot be read.
std::optional<uint32_t> checksumOf(const std::string& path);

}  // namespace hybrid_slam::files
