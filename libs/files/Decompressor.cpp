#include "files/Decompressor.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>

namespace hybrid_slam::files {
namespace {

/// Limits a count to 32 bits, which zlib and bzip2 use.
unsigned counted(size_t bytes) {
  return static_cast<unsigned>(std::min<size_t>(bytes, std::numeric_limits<int>::max()));
}

void advance(std::string_view& in, size_t taken, char*& out, size_t& room, size_t written) {
  in.remove_prefix(taken);
  out += written;
  room -= written;
}

class GzipDecompressor : public Decompressor {
 public:
  GzipDecompressor() {
    constexpr int kGzip = 15 + 16;  // window bits, and gzip's format
    if (inflateInit2(&stream_, kGzip) != Z_OK) throw std::bad_alloc();
  }
  ~GzipDecompressor() override { inflateEnd(&stream_); }
  GzipDecompressor(const GzipDecompressor&) = delete;
  GzipDecompressor& operator=(const GzipDecompressor&) = delete;

  bool decode(std::string_view& in, char*& out, size_t& room) override {
    const unsigned from = counted(in.size()), to = counted(room);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
    stream_.avail_in = from;
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = to;
    const int state = inflate(&stream_, Z_NO_FLUSH);
    advance(in, from - stream_.avail_in, out, room, to - stream_.avail_out);
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      throw Damaged(stream_.msg ? stream_.msg : "wrong data");
    if (state == Z_STREAM_END) inflateReset(&stream_);
    return state == Z_STREAM_END;
  }

 private:
  z_stream stream_{};
};

class Bzip2Decompressor : public Decompressor {
 public:
  Bzip2Decompressor() { begin(); }
  ~Bzip2Decompressor() override { BZ2_bzDecompressEnd(&stream_); }
  Bzip2Decompressor(const Bzip2Decompressor&) = delete;
  Bzip2Decompressor& operator=(const Bzip2Decompressor&) = delete;

  bool decode(std::string_view& in, char*& out, size_t& room) override {
    const unsigned from = counted(in.size()), to = counted(room);
    stream_.next_in = const_cast<char*>(in.data());
    stream_.avail_in = from;
    stream_.next_out = out;
    stream_.avail_out = to;
    const int state = BZ2_bzDecompress(&stream_);
    advance(in, from - stream_.avail_in, out, room, to - stream_.avail_out);
    if (state == BZ_MEM_ERROR) throw std::bad_alloc();
    if (state != BZ_OK && state != BZ_STREAM_END)
      throw Damaged(state == BZ_DATA_ERROR ? "wrong checksum or data" : "wrong data");
    if (state == BZ_STREAM_END) {
      BZ2_bzDecompressEnd(&stream_);
      begin();
    }
    return state == BZ_STREAM_END;
  }

 private:
  void begin() {
    stream_ = {};
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  bz_stream stream_{};
};

class ZstdDecompressor : public Decompressor {
 public:
  bool decode(std::string_view& in, char*& out, size_t& room) override {
    ZSTD_inBuffer from{in.data(), in.size(), 0};
    ZSTD_outBuffer to{out, room, 0};
    const size_t hint = ZSTD_decompressStream(stream_.get(), &to, &from);
    advance(in, from.pos, out, room, to.pos);
    if (ZSTD_isError(hint)) throw Damaged(ZSTD_getErrorName(hint));
    return hint == 0;
  }

 private:
  std::unique_ptr<ZSTD_DStream, size_t (*)(ZSTD_DStream*)> stream_{ZSTD_createDStream(), ZSTD_freeDStream};
};

class Lz4Decompressor : public Decompressor {
 public:
  Lz4Decompressor() {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION))) throw std::bad_alloc();
  }
  ~Lz4Decompressor() override { LZ4F_freeDecompressionContext(context_); }
  Lz4Decompressor(const Lz4Decompressor&) = delete;
  Lz4Decompressor& operator=(const Lz4Decompressor&) = delete;

  bool decode(std::string_view& in, char*& out, size_t& room) override {
    size_t from = in.size(), to = room;
    const size_t hint = LZ4F_decompress(context_, out, &to, in.data(), &from, nullptr);
    if (LZ4F_isError(hint)) throw Damaged(LZ4F_getErrorName(hint));
    advance(in, from, out, room, to);
    return hint == 0;
  }

 private:
  LZ4F_dctx* context_ = nullptr;
};

}  // namespace

const char* nameOf(Compression compression) {
  switch (compression) {
    case Compression::gzip:
      return "gzip";
    case Compression::bzip2:
      return "bzip2";
    case Compression::zstd:
      return "zstd";
    default:
      return "LZ4";
  }
}

std::optional<Compression> compressionOf(std::string_view beginning) {
  const auto begins = [&](std::string_view magic) { return beginning.substr(0, magic.size()) == magic; };
  if (begins("\x1f\x8b")) return Compression::gzip;
  if (begins("\x28\xb5\x2f\xfd")) return Compression::zstd;
  if (begins("\x04\x22\x4d\x18")) return Compression::lz4;
  // `BZh9` could begin a text: a block or the end of the stream follows.
  const bool isBzip2 = begins("BZh") && beginning.size() >= 10 && beginning[3] >= '1' && beginning[3] <= '9';
  const std::string_view next = isBzip2 ? beginning.substr(4, 6) : std::string_view();
  if (next == "1AY&SY" || next == "\x17\x72\x45\x38\x50\x90") return Compression::bzip2;
  return std::nullopt;
}

std::unique_ptr<Decompressor> makeDecompressor(Compression compression) {
  switch (compression) {
    case Compression::gzip:
      return std::make_unique<GzipDecompressor>();
    case Compression::bzip2:
      return std::make_unique<Bzip2Decompressor>();
    case Compression::zstd:
      return std::make_unique<ZstdDecompressor>();
    default:
      return std::make_unique<Lz4Decompressor>();
  }
}

namespace {

/// Decompresses up to `size` bytes, and one more if there are more.
/// @param isWhole  false: the bytes may end too early
std::string decodedUpTo(Compression compression, std::string_view bytes, size_t size, bool isWhole) {
  constexpr size_t kStep = 1 << 20;
  const auto decompressor = makeDecompressor(compression);
  std::string content;
  size_t length = 0;
  bool hasEnded = false;
  while (length <= size && (!hasEnded || !bytes.empty())) {
    content.resize(std::min(size + 1, length + std::max(kStep, length)));
    char* out = content.data() + length;
    size_t room = content.size() - length;
    const size_t before = room, left = bytes.size();
    hasEnded = decompressor->decode(bytes, out, room);
    length += before - room;
    if (hasEnded || room < before || bytes.size() < left) continue;
    if (isWhole) throw Damaged("it is cut off");
    break;
  }
  content.resize(length);
  return content;
}

}  // namespace

std::string decoded(Compression compression, std::string_view bytes, size_t size) {
  std::string content = decodedUpTo(compression, bytes, size, true);
  if (content.size() > size) throw Damaged("its content is longer than it says");
  if (content.size() < size) throw Damaged("its content is shorter than it says");
  return content;
}

std::string decodedStart(Compression compression, std::string_view bytes, size_t size) {
  return decodedUpTo(compression, bytes, size, false).substr(0, size);
}

}  // namespace hybrid_slam::files
