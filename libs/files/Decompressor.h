/// @file Decompressor.h
/// @brief Decompression of gzip, bzip2, zstd and LZ4 frames, piece by piece.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hybrid_slam::files {

/// The formats of compressed files that are read.
enum class Compression { gzip, bzip2, zstd, lz4 };

/// Returns the format's name for messages.
const char* nameOf(Compression compression);

/// Detects the compression from the first 10 bytes of a file, or all of a shorter one; empty: none.
std::optional<Compression> compressionOf(std::string_view beginning);

/// Thrown for bytes that violate the format; what() says how.
struct Damaged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One compressed stream after another, such as the members of a gzip file. Memory does not grow with the
/// data: at most 128 MiB (the window of zstd).
class Decompressor {
 public:
  virtual ~Decompressor() = default;
  /// Decodes as much as possible, and advances `in` and `out` past the bytes read and written.
  /// @return true at the end of a stream; the next call begins another one
  /// @throws Damaged
  virtual bool decode(std::string_view& in, char*& out, size_t& room) = 0;
};

/// Makes a decompressor for one file.
std::unique_ptr<Decompressor> makeDecompressor(Compression compression);

/// Decompresses bytes in memory.
/// @throws Damaged unless the content has exactly `size` bytes. Memory grows with the content, not with
/// `size`.
std::string decoded(Compression compression, std::string_view bytes, size_t size);
/// Decompresses the bytes before a cut, at most `size`. @throws Damaged
std::string decodedStart(Compression compression, std::string_view bytes, size_t size);

}  // namespace hybrid_slam::files
