/// @file wire.cpp
/// @brief The bytes of a server: messages, and the frames in those that pass the checksum.

#include <exception>
#include <string>

#include "live/ObservationWire.h"

using namespace hybrid_slam::live;

namespace {

void decode(const std::string& bytes) {
  MessageDecoder decoder;
  const size_t half = bytes.size() / 2;
  for (const std::string& part : {bytes.substr(0, half), bytes.substr(half)}) {
    decoder.feed(part);
    while (const auto message = decoder.next())
      if (message->kind == MessageKind::cycle) deserialise(message->payload);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    decode(bytes);
  } catch (const WireError&) {
  }
  try {
    decode(encode({MessageKind::cycle, 1, 2, bytes}));  // with the right checksum
  } catch (const WireError&) {
  }
  return 0;
}
