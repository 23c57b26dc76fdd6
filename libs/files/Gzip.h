/// @file Gzip.h
/// @brief Whole gzip files in memory. They have a checksum.
#pragma once

#include <string>
#include <string_view>

namespace hybrid_slam::files {

/// Returns the bytes as the content of a gzip file, without name and time.
/// @param level  1 (fast) to 9 (small)
std::string gzipped(std::string_view bytes, int level = 1);

/// Returns the content of a gzip file.
/// @param what  kind of file, for errors: "session file"
/// @throws InputError for a file that is missing, not compressed, cut, damaged, or holds over `mostBytes`
std::string readGzip(const std::string& path, const std::string& what, size_t mostBytes);

}  // namespace hybrid_slam::files
