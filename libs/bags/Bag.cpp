#include "bags/Bag.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "bags/ByteCursor.h"
#include "bags/McapFile.h"
#include "bags/RecordingFolder.h"
#include "bags/Ros1Bag.h"
#include "bags/Rosbag2Database.h"
#include "base/Errors.h"
#include "files/CompressedFile.h"

namespace hybrid_slam::bags {
namespace {

enum class Kind { none, ros1, oldRos1, database, mcap };

Kind kindOf(const std::string& path) {
  try {
    files::CompressedFile file(path, "");
    std::array<char, 16> start{};
    size_t count = 0;
    while (const size_t got = file.read(start.data() + count, start.size() - count)) count += got;
    const std::string_view bytes(start.data(), count);
    const auto begins = [&](std::string_view magic) { return bytes.substr(0, magic.size()) == magic; };
    if (begins("#ROSBAG V2.0\n")) return Kind::ros1;
    if (begins("#ROSBAG V") || begins("#ROSRECORD V")) return Kind::oldRos1;
    if (begins(std::string_view("SQLite format 3\0", 16))) return Kind::database;
    return begins("\x89MCAP0\r\n") ? Kind::mcap : Kind::none;
  } catch (const InputError&) {
    return Kind::none;
  }
}

}  // namespace

size_t Bag::topicOf(std::string_view name, std::string_view type, Encoding encoding) {
  const auto [found, isNew] = indices_.try_emplace({printable(name), printable(type)}, topics_.size());
  if (isNew && topics_.size() >= kMostTopics) throw BrokenBytes("it has over 10,000 topics");
  if (isNew) topics_.push_back({found->first.first, found->first.second, encoding, messageTypeOf(type)});
  return found->second;
}

bool isBag(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return !filesOfRecording(path).empty();
  return kindOf(path) != Kind::none;
}

std::unique_ptr<Bag> openBag(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return std::make_unique<RecordingFolder>(path);
  switch (kindOf(path)) {
    case Kind::ros1:
      return std::make_unique<Ros1Bag>(path);
    case Kind::mcap:
      return std::make_unique<McapFile>(path);
    case Kind::database:
      return std::make_unique<Rosbag2Database>(path);
    case Kind::oldRos1:
      throw InputError("bag of an old version", path, "expected version 2.0, which `rosbag fix` writes");
    default:
      throw InputError("not a bag", path, "expected a ROS 1 bag, a ROS 2 database (.db3) or an MCAP file");
  }
}

}  // namespace hybrid_slam::bags
