#include "files/Checksum.h"

#include <zlib.h>

#include <fstream>
#include <vector>

namespace hybrid_slam::files {

std::optional<uint32_t> checksumOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  uLong sum = crc32(0, nullptr, 0);
  std::vector<char> block(1 << 16);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
    sum = crc32(sum, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(in.gcount()));
  if (in.bad()) return std::nullopt;
  return static_cast<uint32_t>(sum);
}

}  // namespace hybrid_slam::files
