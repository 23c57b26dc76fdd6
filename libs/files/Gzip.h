/// @file Gzip.h
/// @brief Reads whole gzip files, which have a checksum.
#pragma once

#include <string>
#include <string_view>

namespace hybrid_slam::files {

/// Returns the bytes as the content of a gzip file.
std::string gzipped(std::string_view bytes);

/// Returns the content of a gzip file.
/// @param what  kind of file, for errors: "session file"
/// @throws InputError for a file that is missing, not compressed, cut, damaged, or holds over `mostBytes`
std::string readGzip(const std::string& path, const std::string& what, size_t mostBytes);

}  // namespace hybrid_slam::files
