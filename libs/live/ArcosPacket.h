/// @file ArcosPacket.h
/// @brief The packets of ActivMedia's robots (P2OS, AmigOS, ARCOS) as bytes.
///
/// A packet is 0xFA 0xFB, the count of the bytes that follow, the payload, a checksum (high byte first). A
/// command's payload is its number, and for one with an argument the argument's type and two bytes, low
/// first. The robot sends server information packets (SIP) of the same form, ten a second.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hybrid_slam::live {

namespace arcos {
/// Numbers of the commands that this project sends. None of them moves the robot.
enum Command : uint8_t { sync0 = 0, sync1 = 1, sync2 = 2, pulse = 0, open = 1, close = 2 };
using Payload = std::vector<uint8_t>;

/// Of a payload: big-endian words added up, an odd last byte xored.
uint16_t checksum(const Payload& payload);
std::string encode(const Payload& payload);

/// What a standard SIP says of the robot's motion, in its raw units.
struct Sip {
  uint16_t x = 0, y = 0;  ///< 15-bit counters of about a millimetre
  int16_t heading = 0;    ///< 4096 to the turn
  bool isMoving = false;
};
/// Nothing for a payload that is no standard SIP.
std::optional<Sip> decodeSip(const Payload& payload);

/// Cuts a stream of bytes into payloads, whatever else is in it: it looks for the next packet after a byte
/// that fits nowhere, a count that no packet has, a wrong checksum.
class Decoder {
 public:
  void feed(const std::string& bytes) { buffer_ += bytes; }
  /// The next payload; nothing until more bytes come.
  std::optional<Payload> next();
  size_t damaged() const { return damaged_; }  ///< packets with a wrong count or checksum

 private:
  std::string buffer_;
  size_t damaged_ = 0;
};

}  // namespace arcos
}  // namespace hybrid_slam::live
