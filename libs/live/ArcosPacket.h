/// @file ArcosPacket.h
/// @brief The packet format of ActivMedia robots (P2OS, AmigOS, ARCOS).
///
/// A packet is 0xFA 0xFB, the count of the following bytes, the payload and a checksum (high byte first). A
/// command's payload is its number and, if it has an argument, the argument's type and two bytes, low byte
/// first. The robot sends server information packets (SIP) in the same format, ten per second.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hybrid_slam::live {

namespace arcos {
/// The commands used here. None of them moves the robot.
enum ArcosCommand : uint8_t { sync0 = 0, sync1 = 1, sync2 = 2, pulse = 0, open = 1, close = 2 };
using Payload = std::vector<uint8_t>;

/// Checksum of a payload: sum of big-endian words, an odd last byte xored.
uint16_t checksum(const Payload& payload);
/// Returns the packet of a payload, with its header and checksum.
std::string encode(const Payload& payload);

/// The odometry of a standard SIP, in raw units.
struct Sip {
  uint16_t x = 0, y = 0;  ///< 15-bit counters of about a millimetre
  int16_t heading = 0;    ///< 4096 per turn
  bool isMoving = false;
};
/// Decodes a payload; empty if it is not a standard SIP.
std::optional<Sip> decodeSip(const Payload& payload);

/// Splits a byte stream into payloads. Resynchronises at the next packet after an unexpected byte, an
/// impossible count or a wrong checksum.
class Decoder {
 public:
  void feed(const std::string& bytes) { buffer_ += bytes; }
  /// Returns the next payload; empty until more bytes arrive.
  std::optional<Payload> next();
  size_t damaged() const { return damaged_; }  ///< packets with a wrong count or checksum

 private:
  std::string buffer_;
  size_t damaged_ = 0;
};

}  // namespace arcos
}  // namespace hybrid_slam::live
