/// @file ByteStream.h
/// @brief Reads a file in pieces whose stated lengths may be wrong.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/CompressedFile.h"

namespace hybrid_slam::bags {

/// A file that is read once, from its beginning, as a stream of bytes.
class ByteStream {
 public:
  /// @throws InputError if the file is missing or unreadable
  explicit ByteStream(const std::string& path);

  bool isAtEnd();
  /// Reads `count` bytes. Memory grows with the bytes in the file, not with `count`.
  /// @throws BrokenBytes if it has fewer
  std::string take(uint64_t count);
  /// The same, but up to the end of the file if it has fewer.
  std::string takeUpTo(uint64_t count);
  /// @throws BrokenBytes if the file has fewer bytes
  void skip(uint64_t count);
  /// CRC-32 of the bytes so far.
  uint32_t checksum() const { return checksum_; }

 private:
  size_t read(char* to, size_t count);

  files::CompressedFile file_;
  std::vector<char> buffer_;
  size_t begin_ = 0, end_ = 0;  ///< of the unread part of the buffer
  uint32_t checksum_ = 0;
};

}  // namespace hybrid_slam::bags
