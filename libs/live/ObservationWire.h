/// @file ObservationWire.h
/// @brief The protocol between observation-server and its clients (doc/live.md).
///
/// The server speaks, its clients listen. Each message is a header of 32 bytes, all numbers little-endian,
///
///     0  "HSO1"   8  session (8 bytes)          24  bytes of payload (4)
///     4  kind     16 number of the cycle (8)    28  CRC-32 of bytes 4 to 27 and the payload (4)
///
/// and the payload: of a cycle, a serialised mrpt::obs::CSensoryFrame; of the other kinds, nothing.
#pragma once

#include <mrpt/obs/CSensoryFrame.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace hybrid_slam::live {

enum class MessageKind : uint8_t {
  cycle = 1,      ///< the observations of one cycle, in order of time
  heartbeat = 2,  ///< nothing new; the server lives
  end = 3,        ///< the log that the server replays has ended: nothing comes any more
};

struct Message {
  MessageKind kind = MessageKind::heartbeat;
  uint64_t session = 0;  ///< drawn when the server starts: another one has started its odometry anew
  uint64_t number = 0;   ///< of the cycle, from 1; of the other kinds, that of the last cycle
  std::string payload{};
};

/// Bytes that are not the protocol's.
struct WireError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr size_t kMaxPayload = size_t{16} << 20;  ///< bytes

std::string encode(const Message& message);
std::string serialise(const mrpt::obs::CSensoryFrame& frame);
/// @throws WireError for anything but one whole CSensoryFrame of observations
mrpt::obs::CSensoryFrame::Ptr deserialise(const std::string& payload);

/// Cuts a stream of bytes into messages. After an error it is of no more use: the connection is to be closed.
class MessageDecoder {
 public:
  void feed(const std::string& bytes) { buffer_ += bytes; }
  /// The next whole message; nothing until more bytes come.
  /// @throws WireError for wrong magic bytes, kind, length or checksum
  std::optional<Message> next();

 private:
  std::string buffer_;
};

}  // namespace hybrid_slam::live
