/// @file maps.cpp
/// @brief Maps: grid maps of MRPT, map.yaml, and the pictures that it names.

#include <string>

#include "MemoryFile.h"
#include "base/Errors.h"
#include "run/MapReader.h"
#include "testing/PngFile.h"

using namespace hybrid_slam;

namespace {

/// Makes a PNG file with this header and these pixels, since mutations do not find valid checksums.
std::string pngOf(const std::string& bytes) {
  constexpr size_t kHeader = 13;
  const std::string pixels = bytes.size() > kHeader ? bytes.substr(kHeader) : "";
  return test::pngFile(bytes.substr(0, kHeader), test::deflated(pixels, 1));
}

void read(const std::string& path) {
  try {
    run::readMap(path);
  } catch (const InputError&) {
  }
}

void readAsPicture(const std::string& bytes) {
  const fuzz::MemoryFile picture(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  const std::string text = "{image: " + picture.path() +
                           ", resolution: 0.05, origin: [-1, 2, 0], negate: 0, occupied_thresh: 0.65, "
                           "free_thresh: 0.196, mode: scale}";
  read(fuzz::MemoryFile(reinterpret_cast<const uint8_t*>(text.data()), text.size()).path());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  read(fuzz::MemoryFile(data, size).path());
  const std::string bytes(data, data + size);
  readAsPicture(bytes);
  readAsPicture(pngOf(bytes));
  return 0;
}
