/// @file McapFile.h
/// @brief MCAP files, which ROS 2 records by default.
#pragma once

#include <string>
#include <unordered_map>

#include "bags/Bag.h"
#include "bags/ByteCursor.h"
#include "bags/ByteStream.h"

namespace hybrid_slam::bags {

/// Reads the data section in sequence, and ignores the index after it: a file whose recording was killed is
/// read as far as it goes. The checksums of chunks and of the data section are checked where there are any.
class McapFile : public Bag {
 public:
  explicit McapFile(const std::string& path);
  std::optional<StoredMessage> next() override;
  const char* format() const override { return "MCAP file"; }

 private:
  std::optional<StoredMessage> nextRecord();
  std::optional<StoredMessage> nextInChunk();
  std::optional<StoredMessage> take(uint8_t kind, std::string_view record);
  void openChunk(std::string_view record);
  void noteChannel(std::string_view record);

  ByteStream stream_;
  std::unordered_map<uint16_t, std::string> schemas_;  ///< type of each
  std::unordered_map<uint16_t, size_t> channels_;      ///< topic of each
  std::string record_, chunk_;
  ByteCursor inChunk_{{}};
  bool isAtEnd_ = false;
};

}  // namespace hybrid_slam::bags
