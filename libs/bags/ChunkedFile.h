/// @file ChunkedFile.h
/// @brief Base of the bags that consist of records, some of which are compressed chunks of records.
#pragma once

#include <string>

#include "bags/Bag.h"
#include "bags/ByteCursor.h"
#include "bags/ByteStream.h"
#include "files/Decompressor.h"

namespace hybrid_slam::bags {

/// Reads the records in sequence and ignores the index at the end, so that a killed recording, which has no
/// index, can be read up to its end.
class ChunkedFile : public Bag {
 public:
  std::optional<StoredMessage> next() final;

 protected:
  ChunkedFile(const std::string& path, size_t magicBytes) : stream_(path) { stream_.skip(magicBytes); }

  /// Reads the next record of the file; returns it if it is a message. Sets isAtEnd_ behind the last message,
  /// and inChunk_ if the record is a chunk. @throws BrokenBytes, files::Damaged
  virtual std::optional<StoredMessage> nextRecord() = 0;
  /// Reads the next record of the chunk; returns it if it is a message.
  virtual std::optional<StoredMessage> nextInChunk() = 0;
  /// Reads a record to record_. Of a chunk that is cut off, what is there, and isCut_ is set.
  void takeRecord(uint64_t size, bool isChunk);
  /// @param compression  empty: none
  /// @param size         of the decompressed chunk
  void openChunk(std::optional<files::Compression> compression, std::string_view bytes, uint64_t size);

  ByteStream stream_;
  std::string record_, chunk_;
  ByteCursor inChunk_{{}};
  bool isAtEnd_ = false;
  bool isCut_ = false;  ///< the file ends in the chunk
};

}  // namespace hybrid_slam::bags
