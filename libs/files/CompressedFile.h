/// @file CompressedFile.h
/// @brief The bytes of a file, plain or compressed.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/Decompressor.h"

namespace hybrid_slam::files {

/// Reads a file as a stream with constant memory. Gzip, bzip2, zstd and LZ4 are detected from the content,
/// not the name.
class CompressedFile {
 public:
  /// @param expected  end of the error messages: "expected a readable log"
  /// @throws InputError if the file is missing, not a regular file, or not readable
  CompressedFile(const std::string& path, const std::string& expected);
  ~CompressedFile();

  /// Reads at most `count` bytes.
  /// @return the number read; 0 at the end of the content, or where the file is defective
  size_t read(char* to, size_t count);
  /// "gzip file cut off", "damaged gzip file", "cannot read", "shortened while it was read"; empty while the
  /// file is intact.
  const std::string& defect() const { return defect_; }
  const std::string& reason() const { return reason_; }  ///< of the defect; may be empty
  std::optional<Compression> compression() const { return compression_; }
  void rewind();

 private:
  void refill();
  void fail(const std::string& defect, const std::string& reason);

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  off_t size_;  ///< when it was opened
  std::vector<char> buffer_;
  std::string_view unread_;  ///< part of the buffer
  std::optional<Compression> compression_;
  std::unique_ptr<Decompressor> decompressor_;
  bool isBetweenStreams_ = false;
  std::string defect_, reason_;
};

}  // namespace hybrid_slam::files
