#include "bags/McapFile.h"

#include <zlib.h>

namespace hybrid_slam::bags {
namespace {

constexpr size_t kMagicBytes = 8;
enum McapRecord : uint8_t {
  kMcapFooter = 2,
  kMcapSchema = 3,
  kMcapChannel = 4,
  kMcapMessage = 5,
  kMcapChunk = 6,
  kMcapDataEnd = 15
};

std::string name(ByteCursor& in) { return std::string(in.block().substr(0, kMostNameBytes)); }

}  // namespace

McapFile::McapFile(const std::string& path) : ChunkedFile(path, kMagicBytes) {}

std::optional<StoredMessage> McapFile::nextRecord() {
  const uint32_t checksum = stream_.checksum();
  if (stream_.isAtEnd()) throw BrokenBytes("cut off: it has no end record");
  const std::string head = stream_.take(1 + sizeof(uint64_t));
  ByteCursor in(head);
  const auto kind = in.number<uint8_t>();
  const auto size = in.number<uint64_t>();
  isAtEnd_ = kind == kMcapDataEnd || kind == kMcapFooter;
  if (isAtEnd_) {
    const uint32_t stored =
        kind == kMcapDataEnd ? ByteCursor(stream_.take(sizeof(uint32_t))).number<uint32_t>() : 0;
    if (stored != 0 && stored != checksum) throw BrokenBytes("damaged: a wrong checksum of the whole");
    return std::nullopt;
  }
  if (kind != kMcapSchema && kind != kMcapChannel && kind != kMcapMessage && kind != kMcapChunk) {
    stream_.skip(size);
    return std::nullopt;
  }
  takeRecord(size, kind == kMcapChunk);
  return take(kind, record_);
}

std::optional<StoredMessage> McapFile::nextInChunk() {
  const auto kind = inChunk_.number<uint8_t>();
  const auto size = inChunk_.number<uint64_t>();
  const std::string_view record = inChunk_.take(size);
  return kind == kMcapChunk ? std::nullopt : take(kind, record);
}

std::optional<StoredMessage> McapFile::take(uint8_t kind, std::string_view record) {
  ByteCursor in(record);
  if (kind == kMcapSchema) {
    const auto id = in.number<uint16_t>();
    schemas_[id] = name(in);
  } else if (kind == kMcapChannel) {
    noteChannel(record);
  } else if (kind == kMcapChunk) {
    readChunk(record);
  } else if (kind == kMcapMessage) {
    const auto channel = channels_.find(in.number<uint16_t>());
    if (channel == channels_.end()) throw BrokenBytes("a message without a channel");
    in.number<uint32_t>();  // sequence number
    const double time = 1e-9 * static_cast<double>(in.number<uint64_t>());
    in.number<uint64_t>();  // time of publication
    return StoredMessage{channel->second, time, in.take(in.left())};
  }
  return std::nullopt;
}

void McapFile::noteChannel(std::string_view record) {
  ByteCursor in(record);
  const auto id = in.number<uint16_t>();
  const auto schema = schemas_.find(in.number<uint16_t>());
  const std::string topic = name(in), encoding = name(in);
  const bool isRead = encoding == "cdr" || encoding == "ros1";
  const std::string type = schema == schemas_.end() ? "" : schema->second;
  channels_[id] = topicOf(topic, isRead ? type : type + " (" + encoding + ")",
                          encoding == "ros1" ? Encoding::ros1 : Encoding::cdr);
}

void McapFile::readChunk(std::string_view record) {
  ByteCursor in(record);
  in.take(2 * sizeof(uint64_t));  // times of its first and last message
  const auto size = in.number<uint64_t>();
  const auto checksum = in.number<uint32_t>();
  const std::string_view compression = in.block();
  const auto stored = in.number<uint64_t>();
  const std::string_view bytes = in.take(isCut_ ? in.left() : stored);
  if (compression == "zstd")
    openChunk(files::Compression::zstd, bytes, size);
  else if (compression == "lz4")
    openChunk(files::Compression::lz4, bytes, size);
  else if (compression.empty())
    openChunk(std::nullopt, bytes, size);
  else
    throw BrokenBytes("a chunk of unknown compression");
  if (isCut_) return;
  const auto found =
      crc32(0, reinterpret_cast<const Bytef*>(chunk_.data()), static_cast<uInt>(chunk_.size()));
  if (checksum != 0 && checksum != found) throw BrokenBytes("damaged chunk (wrong checksum)");
}

}  // namespace hybrid_slam::bags
