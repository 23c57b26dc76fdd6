/// @file Gzip.h
/// @brief Whole files compressed with gzip, whose format has a checksum.
#pragma once

#include <string>
#include <string_view>

namespace hybrid_slam::files {

std::string gzipped(std::string_view bytes);

/// The content of a compressed file.
/// @param what  that the file should be, for errors: "session file"
/// @throws InputError for a file that is missing, not compressed, cut, damaged, or holds over `mostBytes`
std::string readGzip(const std::string& path, const std::string& what, size_t mostBytes);

}  // namespace hybrid_slam::files
