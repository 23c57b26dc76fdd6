/// @file McapFile.h
/// @brief MCAP files, which ROS 2 records by default.
#pragma once

#include <string>
#include <unordered_map>

#include "bags/ChunkedFile.h"

namespace hybrid_slam::bags {

/// Checks the checksums of chunks and of the data section where they exist.
class McapFile : public ChunkedFile {
 public:
  explicit McapFile(const std::string& path);
  const char* format() const override { return "MCAP file"; }

 private:
  std::optional<StoredMessage> nextRecord() override;
  std::optional<StoredMessage> nextInChunk() override;
  std::optional<StoredMessage> take(uint8_t kind, std::string_view record);
  void readChunk(std::string_view record);
  void noteChannel(std::string_view record);

  std::unordered_map<uint16_t, std::string> schemas_;  ///< type of each
  std::unordered_map<uint16_t, size_t> channels_;      ///< topic of each
};

}  // namespace hybrid_slam::bags
