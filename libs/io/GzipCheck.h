/// @file GzipCheck.h
/// @brief MRPT's gzip writer does not tell of a full disk; reading back does.
#pragma once

#include <string>

namespace hybrid_slam {

/// Whether a gzip file ends as it should, checksum included.
bool isWholeGzip(const std::string& file);

}  // namespace hybrid_slam
