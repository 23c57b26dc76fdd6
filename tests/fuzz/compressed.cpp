/// @file compressed.cpp
/// @brief Decompression: gzip, bzip2, zstd and LZ4 files, and the chunks of bags.

#include <string_view>
#include <vector>

#include "MemoryFile.h"
#include "base/Errors.h"
#include "files/CompressedFile.h"

using namespace hybrid_slam;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr size_t kMost = 1 << 22;  // bytes: a file may expand without end
  const fuzz::MemoryFile file(data, size);
  files::CompressedFile in(file.path(), "");
  std::vector<char> buffer(1 << 16);
  for (size_t total = 0; total < kMost;) {
    const size_t count = in.read(buffer.data(), buffer.size());
    if (count == 0) break;
    total += count;
  }
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const auto compression : {files::Compression::gzip, files::Compression::bzip2,
                                 files::Compression::zstd, files::Compression::lz4})
    for (const size_t claimed : {size, kMost}) try {
        files::decoded(compression, bytes, claimed);
      } catch (const files::Damaged&) {
      }
  return 0;
}
