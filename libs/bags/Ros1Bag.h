/// @file Ros1Bag.h
/// @brief ROS 1 bags, version 2.0.
#pragma once

#include <string>
#include <unordered_map>

#include "bags/Bag.h"
#include "bags/ByteCursor.h"
#include "bags/ByteStream.h"

namespace hybrid_slam::bags {

/// Reads the records in sequence, not through the index at the end: a bag whose recording was killed, which
/// has no index, is read as far as it goes.
class Ros1Bag : public Bag {
 public:
  explicit Ros1Bag(const std::string& path);
  std::optional<StoredMessage> next() override;
  const char* format() const override { return "ROS 1 bag"; }

 private:
  std::optional<StoredMessage> nextRecord();
  std::optional<StoredMessage> nextInChunk();
  void openChunk(std::string_view header, std::string_view data);
  void noteConnection(std::string_view header, std::string_view data);
  std::optional<StoredMessage> messageOf(std::string_view header, std::string_view data) const;

  ByteStream stream_;
  std::unordered_map<uint32_t, size_t> connections_;  ///< topic of each
  std::string record_;                                ///< data of the last top-level message
  std::string chunk_;
  ByteCursor inChunk_{{}};
  bool isAtEnd_ = false;
};

}  // namespace hybrid_slam::bags
