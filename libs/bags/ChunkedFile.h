/// @file ChunkedFile.h
/// @brief What bags of records have in common: records in sequence, some of them compressed chunks of
/// records.
#pragma once

#include <string>

#include "bags/Bag.h"
#include "bags/ByteCursor.h"
#include "bags/ByteStream.h"
#include "files/Decoder.h"

namespace hybrid_slam::bags {

/// Reads the records in sequence, not through the index at the end: a file whose recording was killed, which
/// has no index, is read as far as it goes.
class ChunkedFile : public Bag {
 public:
  std::optional<StoredMessage> next() final;

 protected:
  ChunkedFile(const std::string& path, size_t magicBytes) : stream_(path) { stream_.skip(magicBytes); }

  /// The next record of the file, if it is a message. Sets isAtEnd_ behind the last message, and inChunk_ if
  /// the record is a chunk. @throws BrokenBytes, files::Damaged
  virtual std::optional<StoredMessage> nextRecord() = 0;
  /// The same within the chunk.
  virtual std::optional<StoredMessage> nextInChunk() = 0;
  /// @param compression  empty: none
  /// @param size         of the chunk, decompressed
  void openChunk(std::optional<files::Compression> compression, std::string_view bytes, uint64_t size);

  ByteStream stream_;
  std::string record_, chunk_;
  ByteCursor inChunk_{{}};
  bool isAtEnd_ = false;
};

}  // namespace hybrid_slam::bags
