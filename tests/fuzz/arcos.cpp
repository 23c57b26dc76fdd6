/// @file arcos.cpp
/// @brief The bytes of a Pioneer, up to its odometry.

#include <string>

#include "live/ArcosPacket.h"
#include "live/SipOdometry.h"

using namespace hybrid_slam::live;

namespace {

void decode(const std::string& bytes) {
  arcos::Decoder decoder;
  SipOdometry odometry(0.001);
  for (size_t at = 0; at < bytes.size(); at += 7) {
    decoder.feed(bytes.substr(at, 7));
    while (const auto payload = decoder.next())
      if (const auto sip = arcos::decodeSip(*payload)) odometry(*sip);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  decode(bytes);
  if (size < 200) decode(arcos::encode({data, data + size}));  // with the right checksum
  return 0;
}
