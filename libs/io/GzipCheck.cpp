#include "io/GzipCheck.h"

#include <zlib.h>

#include <array>

namespace hybrid_slam {

bool isWholeGzip(const std::string& file) {
  const gzFile in = gzopen(file.c_str(), "rb");
  if (!in) return false;
  std::array<char, 65536> buffer;
  int n = 0;
  bool isEmpty = true;
  while ((n = gzread(in, buffer.data(), buffer.size())) > 0) isEmpty = false;
  int error = Z_OK;
  gzerror(in, &error);
  return gzclose(in) == Z_OK && n == 0 && error == Z_OK && !isEmpty;
}

}  // namespace hybrid_slam
