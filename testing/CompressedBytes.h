/// @file CompressedBytes.h
/// @brief For the tests: content in each compression that is read.
#pragma once

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <memory>
#include <string>

#include "files/Decompressor.h"
#include "files/Gzip.h"

namespace hybrid_slam::test {

inline constexpr files::Compression kCompressions[] = {files::Compression::gzip, files::Compression::bzip2,
                                                       files::Compression::zstd, files::Compression::lz4};

/// One stream, with its checksum.
inline std::string compressed(files::Compression compression, const std::string& text) {
  if (compression == files::Compression::gzip) return files::gzipped(text);
  std::string out(2 * text.size() + 1000, '\0');
  size_t length = 0;
  if (compression == files::Compression::bzip2) {
    auto size = static_cast<unsigned>(out.size());
    BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(text.data()),
                             static_cast<unsigned>(text.size()), 1, 0, 0);
    length = size;
  } else if (compression == files::Compression::zstd) {
    // Like the program zstd, with a checksum.
    const std::unique_ptr<ZSTD_CCtx, size_t (*)(ZSTD_CCtx*)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    length = ZSTD_compress2(context.get(), out.data(), out.size(), text.data(), text.size());
  } else {
    LZ4F_preferences_t preferences{};
    preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
    length = LZ4F_compressFrame(out.data(), out.size(), text.data(), text.size(), &preferences);
  }
  return out.substr(0, length);
}

}  // namespace hybrid_slam::test
