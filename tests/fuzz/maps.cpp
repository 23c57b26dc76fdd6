/// @file maps.cpp
/// @brief Maps: grid maps of MRPT, map.yaml, and the pictures that it names.

#include <zlib.h>

#include <string>

#include "MemoryFile.h"
#include "base/Errors.h"
#include "run/MapReader.h"

using namespace hybrid_slam;

namespace {

std::string bigEndian(uLong value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& content) {
  const std::string checked = type + content;
  return bigEndian(content.size()) + checked +
         bigEndian(
             ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size())));
}

/// Makes a PNG file with this header and these pixels, since mutations do not find valid checksums.
std::string pngOf(const std::string& bytes) {
  constexpr size_t kHeader = 13;
  const std::string pixels = bytes.size() > kHeader ? bytes.substr(kHeader) : "";
  std::string deflated(::compressBound(pixels.size()), '\0');
  uLongf size = deflated.size();
  ::compress2(reinterpret_cast<Bytef*>(deflated.data()), &size, reinterpret_cast<const Bytef*>(pixels.data()),
              pixels.size(), 1);
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", bytes.substr(0, kHeader)) +
         chunk("IDAT", deflated.substr(0, size)) + chunk("IEND", "");
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
