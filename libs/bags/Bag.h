/// @file Bag.h
/// @brief ROS recordings: messages by topic, in the order of recording.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bags/Messages.h"

namespace hybrid_slam::bags {

/// A topic of a recording.
struct Topic {
  std::string name;  ///< without control characters
  std::string type;  ///< `sensor_msgs/LaserScan`, `sensor_msgs/msg/LaserScan`
  Encoding encoding = Encoding::ros1;
  std::optional<MessageType> messageType;  ///< empty: messages of this topic are not read
};

/// A message as it is stored, not yet decoded.
struct StoredMessage {
  size_t topic = 0;        ///< index in topics()
  double time = 0;         ///< s; time of recording
  std::string_view bytes;  ///< until the next call; may be empty if the topic's messages are not read
};

/// A recording, read as a stream. Memory is bounded by its largest chunk, at most 256 MiB.
class Bag {
 public:
  virtual ~Bag() = default;
  /// Returns the next message; empty at the end, or where the file is cut or damaged (see `defect`).
  virtual std::optional<StoredMessage> next() = 0;

  const std::vector<Topic>& topics() const { return topics_; }  ///< found so far
  const std::string& defect() const { return defect_; }         ///< empty for an intact file
  virtual const char* format() const = 0;                       ///< for the user: "ROS 1 bag"

 protected:
  /// Returns the index of a topic; adds a new one.
  /// @throws BrokenBytes if there are too many
  size_t topicOf(std::string_view name, std::string_view type, Encoding encoding);

  std::vector<Topic> topics_;
  std::string defect_;

 private:
  std::map<std::pair<std::string, std::string>, size_t> indices_;
};

/// Returns whether a file or folder begins like a ROS recording.
bool isBag(const std::string& path);

/// Opens a ROS 1 bag, a ROS 2 database or MCAP file, or the folder of a ROS 2 recording. A file may be
/// compressed (files/CompressedFile.h).
/// @throws InputError if it cannot be read, or is of another kind
std::unique_ptr<Bag> openBag(const std::string& path);

constexpr size_t kMostChunkBytes = size_t{256} << 20;
constexpr size_t kMostNameBytes = 1000, kMostTopics = 10000;

}  // namespace hybrid_slam::bags
