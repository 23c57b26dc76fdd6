/// @file token.cpp
/// @brief The token file of an observation-server and its clients, and what a stranger shows.

#include <string>

#include "MemoryFile.h"
#include "base/Errors.h"
#include "live/Token.h"

using namespace hybrid_slam;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string shown(data, data + size);
  live::isSameToken(shown, "0123456789abcdef");
  const fuzz::MemoryFile file(data, size);
  try {
    live::isSameToken(shown, live::readToken(file.path(), ""));
  } catch (const InputError&) {
  }
  return 0;
}
