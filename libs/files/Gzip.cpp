#include "files/Gzip.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include "base/Errors.h"
#include "files/InputFile.h"

namespace hybrid_slam::files {
namespace {

constexpr int kGzip = 15 + 16;   // window bits, and gzip's format
constexpr int kMemoryLevel = 8;  // zlib's default
constexpr size_t kBlock = 1 << 16;

}  // namespace

std::string gzipped(std::string_view bytes, int level) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, deflateEnd);
  std::string out;
  std::vector<char> block(kBlock);
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    const size_t taken = std::min<size_t>(bytes.size(), 1 << 30);  // zlib counts in 32 bits
    if (stream.avail_in == 0) {
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream.avail_in = static_cast<uInt>(taken);
      bytes.remove_prefix(taken);
    }
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    state = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    out.append(block.data(), block.size() - stream.avail_out);
  }
  return out;
}

std::string readGzip(const std::string& path, const std::string& what, size_t mostBytes) {
  const std::string expected = "expected a " + what;
  expectFile(path, expected);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError("cannot read", path, expected);
  z_stream stream{};
  if (inflateInit2(&stream, kGzip) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
  std::string out;
  std::vector<char> from(kBlock), to(kBlock);
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (stream.avail_in == 0) {
      in.read(from.data(), static_cast<std::streamsize>(from.size()));
      if (in.gcount() == 0) throw InputError(out.empty() ? "not a " + what : "cut", path, expected);
      stream.next_in = reinterpret_cast<Bytef*>(from.data());
      stream.avail_in = static_cast<uInt>(in.gcount());
    }
    stream.next_out = reinterpret_cast<Bytef*>(to.data());
    stream.avail_out = static_cast<uInt>(to.size());
    state = inflate(&stream, Z_NO_FLUSH);
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      throw InputError(out.empty() ? "not a " + what : "damaged", path, expected);
    out.append(to.data(), to.size() - stream.avail_out);
    if (out.size() > mostBytes)
      throw InputError("too large", path,
                       expected + " of at most " + std::to_string(mostBytes >> 20) + " MiB");
  }
  if (stream.avail_in > 0 || in.peek() != std::ifstream::traits_type::eof())
    throw InputError("damaged", path, expected + ", with no bytes behind its end");
  return out;
}

}  // namespace hybrid_slam::files
