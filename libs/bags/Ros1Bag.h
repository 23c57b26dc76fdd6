/// @file Ros1Bag.h
/// @brief ROS 1 bags, version 2.0.
#pragma once

#include <string>
#include <unordered_map>

#include "bags/ChunkedFile.h"

namespace hybrid_slam::bags {

/// A ROS 1 bag. Its chunks are read one after another, without the index.
class Ros1Bag : public ChunkedFile {
 public:
  explicit Ros1Bag(const std::string& path);
  const char* format() const override { return "ROS 1 bag"; }

 private:
  std::optional<StoredMessage> nextRecord() override;
  std::optional<StoredMessage> nextInChunk() override;
  void readChunk(std::string_view header, std::string_view data);
  void noteConnection(std::string_view header, std::string_view data);
  std::optional<StoredMessage> messageOf(std::string_view header, std::string_view data) const;

  std::unordered_map<uint32_t, size_t> connections_;  ///< topic of each
};

}  // namespace hybrid_slam::bags
