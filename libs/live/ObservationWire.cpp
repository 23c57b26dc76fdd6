#include "live/ObservationWire.h"

#include <zlib.h>

#include <vector>

#include "base/Errors.h"
#include "files/ObjectReader.h"
#include "files/ObjectWalk.h"

namespace hybrid_slam::live {
namespace {

constexpr char kMagic[] = "HSO1";
constexpr size_t kHeader = 32, kKind = 4, kSession = 8, kNumber = 16, kLength = 24, kChecksum = 28;

void put(std::string& bytes, size_t at, size_t count, uint64_t value) {
  for (size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i) & 0xff);
}

uint64_t get(const std::string& bytes, size_t at, size_t count) {
  uint64_t value = 0;
  for (size_t i = count; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Checksum of a message from `kKind` on, without the checksum field.
uint32_t checksumOf(const std::string& bytes, size_t size) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  const uLong header = ::crc32(0, data + kKind, kChecksum - kKind);
  return static_cast<uint32_t>(::crc32(header, data + kHeader, static_cast<uInt>(size - kHeader)));
}

}  // namespace

std::string encode(const Message& message) {
  std::string bytes(kHeader, '\0');
  bytes.replace(0, kKind, kMagic, kKind);
  put(bytes, kKind, 1, static_cast<uint64_t>(message.kind));
  put(bytes, kSession, 8, message.session);
  put(bytes, kNumber, 8, message.number);
  put(bytes, kLength, 4, message.payload.size());
  bytes += message.payload;
  put(bytes, kChecksum, 4, checksumOf(bytes, bytes.size()));
  return bytes;
}

std::optional<Message> MessageDecoder::next() {
  // Detect an error at the first wrong byte, before the header is complete.
  if (buffer_.compare(0, kKind, kMagic, std::min(buffer_.size(), kKind)) != 0)
    throw WireError("bytes that are not a message");
  if (buffer_.size() < kHeader) return std::nullopt;
  const uint64_t kind = get(buffer_, kKind, 4), length = get(buffer_, kLength, 4);
  if (kind < 1 || kind > 3) throw WireError("a message of unknown kind " + std::to_string(kind));
  if (length > kMaxPayload) throw WireError("a message of " + std::to_string(length) + " bytes");
  const size_t size = kHeader + length;
  if (buffer_.size() < size) return std::nullopt;
  if (get(buffer_, kChecksum, 4) != checksumOf(buffer_, size))
    throw WireError("a message with a wrong checksum");
  Message message{static_cast<MessageKind>(kind), get(buffer_, kSession, 8), get(buffer_, kNumber, 8),
                  buffer_.substr(kHeader, length)};
  buffer_.erase(0, size);
  return message;
}

std::string serialise(const mrpt::obs::CSensoryFrame& frame) {
  std::vector<uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&frame, bytes);
  return {bytes.begin(), bytes.end()};
}

mrpt::obs::CSensoryFrame::Ptr deserialise(const std::string& payload) {
  try {
    files::ObjectBytes bytes(payload);
    files::ObjectWalk walk(bytes, false);
    walk.object(files::ObjectKind::frame);
    if (walk.at() != payload.size()) throw WireError("bytes after the object");
    return std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(files::buildObject(walk.rest()));
  } catch (const WireError&) {
    throw;
  } catch (const std::exception& e) {
    throw WireError("an unreadable object (" + messageOf(e) + ")");
  }
}

}  // namespace hybrid_slam::live
