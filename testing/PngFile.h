/// @file PngFile.h
/// @brief For the tests: PNG files made by hand, also impossible ones.
#pragma once

#include <zlib.h>

#include <string>

namespace hybrid_slam::test {

inline std::string bigEndian(size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

inline std::string pngChunk(const std::string& type, const std::string& content) {
  const std::string checked = type + content;
  const uLong sum =
      ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return bigEndian(content.size()) + checked + bigEndian(sum);
}

/// @param header  content of IHDR
/// @param pixels  content of IDAT
inline std::string pngFile(const std::string& header, const std::string& pixels) {
  return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + pngChunk("IDAT", pixels) + pngChunk("IEND", "");
}

inline std::string deflated(const std::string& bytes, int level = Z_DEFAULT_COMPRESSION) {
  std::string out(::compressBound(bytes.size()), '\0');
  uLongf size = out.size();
  ::compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
              bytes.size(), level);
  return out.substr(0, size);
}

}  // namespace hybrid_slam::test
