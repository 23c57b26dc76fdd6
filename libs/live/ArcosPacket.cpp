#include "live/ArcosPacket.h"

namespace hybrid_slam::live::arcos {
namespace {

constexpr char kFirst = '\xFA', kSecond = '\xFB';
constexpr size_t kHead = 3, kChecksum = 2;
constexpr size_t kShortest = kChecksum + 1, kLongest = 204;  // counts: a packet has at most 207 bytes

uint8_t byteAt(const std::string& bytes, size_t i) { return static_cast<uint8_t>(bytes[i]); }

uint16_t low15(const Payload& p, size_t i) { return static_cast<uint16_t>((p[i] | p[i + 1] << 8) & 0x7fff); }

}  // namespace

uint16_t checksum(const Payload& payload) {
  unsigned sum = 0;
  for (size_t i = 0; i + 1 < payload.size(); i += 2)
    sum += static_cast<unsigned>(payload[i]) << 8 | payload[i + 1];
  if (payload.size() % 2 == 1) sum = (sum & 0xffff) ^ payload.back();
  return static_cast<uint16_t>(sum & 0xffff);
}

std::string encode(const Payload& payload) {
  const uint16_t sum = checksum(payload);
  std::string bytes{kFirst, kSecond, static_cast<char>(payload.size() + kChecksum)};
  bytes.append(payload.begin(), payload.end());
  bytes.push_back(static_cast<char>(sum >> 8));
  bytes.push_back(static_cast<char>(sum & 0xff));
  return bytes;
}

std::optional<Payload> Decoder::next() {
  while (true) {
    const size_t start = buffer_.find(kFirst);
    buffer_.erase(0, std::min(start, buffer_.size()));
    if (buffer_.size() < kHead) return std::nullopt;
    const size_t count = byteAt(buffer_, 2);
    if (buffer_[1] != kSecond) {
      buffer_.erase(0, 1);
      continue;
    }
    if (count < kShortest || count > kLongest) {
      ++damaged_;
      buffer_.erase(0, 2);
      continue;
    }
    if (buffer_.size() < kHead + count) return std::nullopt;
    const Payload payload(buffer_.begin() + kHead,
                          buffer_.begin() + static_cast<std::ptrdiff_t>(kHead + count - kChecksum));
    const unsigned told =
        static_cast<unsigned>(byteAt(buffer_, kHead + count - 2)) << 8 | byteAt(buffer_, kHead + count - 1);
    if (told == checksum(payload)) {
      buffer_.erase(0, kHead + count);
      return payload;
    }
    // After a wrong count, a complete packet may be inside this one.
    ++damaged_;
    buffer_.erase(0, 2);
  }
}

std::optional<Sip> decodeSip(const Payload& payload) {
  constexpr uint8_t kStopped = 0x32, kMoving = 0x33;
  constexpr size_t kNeeded = 7;
  if (payload.size() < kNeeded || (payload[0] != kStopped && payload[0] != kMoving)) return std::nullopt;
  return Sip{low15(payload, 1), low15(payload, 3), static_cast<int16_t>(payload[5] | payload[6] << 8),
             payload[0] == kMoving};
}

}  // namespace hybrid_slam::live::arcos
