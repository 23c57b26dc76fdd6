/// @file message.cpp
/// @brief Messages of ROS 1 and 2. The first byte of the input chooses the type and the encoding.

#include "bags/ByteCursor.h"
#include "bags/Messages.h"

using namespace hybrid_slam::bags;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  constexpr MessageType kTypes[] = {MessageType::laserScan, MessageType::multiEchoLaserScan,
                                    MessageType::odometry, MessageType::transforms};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    decodeMessage(kTypes[data[0] & 3], data[0] & 4 ? Encoding::cdr : Encoding::ros1, bytes);
  } catch (const BrokenBytes&) {
  }
  return 0;
}
