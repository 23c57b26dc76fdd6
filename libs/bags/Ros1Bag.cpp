#include "bags/Ros1Bag.h"

namespace hybrid_slam::bags {
namespace {

constexpr size_t kMostHeaderBytes = 1 << 20;
enum BagRecord : uint8_t {
  kBagMessage = 2,
  kBagHeader = 3,
  kBagIndex = 4,
  kBagChunk = 5,
  kBagChunkInfo = 6,
  kBagConnection = 7
};

/// The value of a field `name=value`; empty if there is none.
std::string_view field(std::string_view header, std::string_view name) {
  for (ByteCursor in(header); in.left() > 0;) {
    const std::string_view one = in.block();
    if (one.size() > name.size() && one[name.size()] == '=' && one.substr(0, name.size()) == name)
      return one.substr(name.size() + 1);
  }
  return {};
}

template <class Number>
Number numberIn(std::string_view header, std::string_view name) {
  const std::string_view value = field(header, name);
  if (value.size() != sizeof(Number)) throw BrokenBytes("a record has no " + std::string(name));
  return ByteCursor(value).number<Number>();
}

std::string nameIn(std::string_view header, std::string_view name) {
  return std::string(field(header, name).substr(0, kMostNameBytes));
}

}  // namespace

Ros1Bag::Ros1Bag(const std::string& path) : ChunkedFile(path, sizeof("#ROSBAG V2.0\n") - 1) {}

std::optional<StoredMessage> Ros1Bag::nextRecord() {
  if (stream_.isAtEnd()) throw BrokenBytes("cut off: it has no index");  // as after a crash
  const auto length = [this](size_t most, const char* what) {
    const std::string bytes = stream_.take(sizeof(uint32_t));
    const auto count = ByteCursor(bytes).number<uint32_t>();
    if (count > most) throw BrokenBytes(what);
    return count;
  };
  const std::string header = stream_.take(length(kMostHeaderBytes, "a record's header is over 1 MiB"));
  const auto kind = numberIn<uint8_t>(header, "op");
  if (kind == kBagHeader && !field(header, "encryptor").empty()) throw BrokenBytes("encrypted");
  const auto size = length(UINT32_MAX, "");
  if (kind == kBagChunkInfo) {  // of the index at the end: all messages come before
    isAtEnd_ = true;
    return std::nullopt;
  }
  if (kind == kBagIndex) {  // bags of 2010 state a wrong length
    constexpr uint64_t kEntryBytes = 12;
    stream_.skip(kEntryBytes * numberIn<uint32_t>(header, "count"));
    return std::nullopt;
  }
  if (kind != kBagMessage && kind != kBagChunk && kind != kBagConnection) {
    stream_.skip(size);
    return std::nullopt;
  }
  takeRecord(size, kind == kBagChunk);
  if (kind == kBagMessage) return messageOf(header, record_);
  if (kind == kBagChunk)
    readChunk(header, record_);
  else
    noteConnection(header, record_);
  return std::nullopt;
}

std::optional<StoredMessage> Ros1Bag::nextInChunk() {
  const std::string_view header = inChunk_.block(), data = inChunk_.block();
  const auto kind = numberIn<uint8_t>(header, "op");
  if (kind == kBagMessage) return messageOf(header, data);
  if (kind == kBagConnection) noteConnection(header, data);
  return std::nullopt;
}

void Ros1Bag::readChunk(std::string_view header, std::string_view data) {
  const std::string_view compression = field(header, "compression");
  const auto size = numberIn<uint32_t>(header, "size");
  if (compression == "bz2")
    openChunk(files::Compression::bzip2, data, size);
  else if (compression == "lz4")
    openChunk(files::Compression::lz4, data, size);
  else if (compression == "none")
    openChunk(std::nullopt, data, size);
  else
    throw BrokenBytes("a chunk of unknown compression");
}

void Ros1Bag::noteConnection(std::string_view header, std::string_view data) {
  const auto id = numberIn<uint32_t>(header, "conn");
  if (connections_.size() >= 10 * kMostTopics) throw BrokenBytes("it has over 100,000 connections");
  connections_.emplace(id, topicOf(nameIn(header, "topic"), nameIn(data, "type"), Encoding::ros1));
}

std::optional<StoredMessage> Ros1Bag::messageOf(std::string_view header, std::string_view data) const {
  const auto connection = connections_.find(numberIn<uint32_t>(header, "conn"));
  if (connection == connections_.end()) throw BrokenBytes("a message without a connection");
  ByteCursor time(field(header, "time"));
  const double seconds = time.number<uint32_t>();
  return StoredMessage{connection->second, seconds + 1e-9 * time.number<uint32_t>(), data};
}

}  // namespace hybrid_slam::bags
