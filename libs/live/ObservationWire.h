/// @file ObservationWire.h
/// @brief The protocol between observation-server and its clients (doc/live.md).
///
/// Only the server sends. Each message is a header of 32 bytes, all numbers little-endian,
///
///     0  "HSO1"   8  session (8 bytes)          24  bytes of payload (4)
///     4  kind     16 number of the cycle (8)    28  CRC-32 of bytes 4 to 27 and the payload (4)
///
/// and the payload: a serialised mrpt::obs::CSensoryFrame for a cycle, empty for the other kinds. The frame
/// holds observations of the classes in files/ObjectLayouts.h only.
#pragma once

#include <mrpt/obs/CSensoryFrame.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace hybrid_slam::live {

/// What a message says.
enum class MessageKind : uint8_t {
  cycle = 1,      ///< the observations of one cycle, in order of time
  heartbeat = 2,  ///< no data; the server is alive
  end = 3,        ///< the replayed log has ended
};

/// A message of the server.
struct Message {
  MessageKind kind = MessageKind::heartbeat;
  uint64_t session = 0;  ///< random, drawn at server start: a new session means restarted odometry
  uint64_t number = 0;   ///< of the cycle, from 1; for other kinds, the last cycle's number
  std::string payload{};
};

/// Thrown for a protocol violation.
struct WireError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr size_t kMaxPayload = size_t{16} << 20;  ///< bytes

/// Returns the bytes of a message, with its length and checksum.
std::string encode(const Message& message);
/// Returns the payload of a cycle.
std::string serialise(const mrpt::obs::CSensoryFrame& frame);
/// @throws WireError for anything but one whole CSensoryFrame of observations; no memory is
/// taken for lengths that the bytes only claim
mrpt::obs::CSensoryFrame::Ptr deserialise(const std::string& payload);

/// Splits a byte stream into messages. Unusable after an error: close the connection.
class MessageDecoder {
 public:
  void feed(const std::string& bytes) { buffer_ += bytes; }
  /// Returns the next complete message; empty until more bytes arrive.
  /// @throws WireError for wrong magic bytes, kind, length or checksum
  std::optional<Message> next();

 private:
  std::string buffer_;
};

}  // namespace hybrid_slam::live
