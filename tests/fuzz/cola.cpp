/// @file cola.cpp
/// @brief The bytes of an LMS-100, up to its scans.

#include <cstdint>
#include <string>

#include "live/ColaTelegram.h"

using namespace hybrid_slam::live;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  cola::decodeScan(bytes);
  cola::Decoder decoder;
  for (size_t at = 0; at < bytes.size(); at += 97) {
    decoder.feed(bytes.substr(at, 97));
    while (const auto telegram = decoder.next()) cola::decodeScan(*telegram);
  }
  return 0;
}
