/// @file Decoder.h
/// @brief Decompression of gzip, bzip2, zstd and LZ4 frames, piece by piece.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hybrid_slam::files {

enum class Compression { gzip, bzip2, zstd, lz4 };

const char* nameOf(Compression compression);

/// The compression that the first bytes of a file (at least kMagicSize, if it has as many) tell; empty: none.
std::optional<Compression> compressionOf(std::string_view beginning);
constexpr size_t kMagicSize = 10;

/// Bytes that are not of the format; what() says how.
struct Damaged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One compressed stream after another, such as the members of a gzip file. Memory does not grow with the
/// data: at most 128 MiB (the window of zstd).
class Decoder {
 public:
  virtual ~Decoder() = default;
  /// Decodes what it can. `in` loses the bytes read, `out` those written.
  /// @return whether a stream has ended: the next call begins another one
  /// @throws Damaged
  virtual bool decode(std::string_view& in, char*& out, size_t& room) = 0;
};

std::unique_ptr<Decoder> makeDecoder(Compression compression);

/// The content of compressed bytes in memory.
/// @throws Damaged unless it is of exactly `size` bytes. Memory grows with the content, not with `size`.
std::string decoded(Compression compression, std::string_view bytes, size_t size);

}  // namespace hybrid_slam::files
