#include "bags/ByteStream.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "bags/ByteCursor.h"

namespace hybrid_slam::bags {

ByteStream::ByteStream(const std::string& path) : file_(path, "expected a readable log"), buffer_(1 << 16) {}

bool ByteStream::isAtEnd() {
  if (begin_ == end_) {
    begin_ = 0;
    end_ = file_.read(buffer_.data(), buffer_.size());
    if (end_ == 0 && !file_.defect().empty()) throw BrokenBytes(file_.defect());
  }
  return begin_ == end_;
}

size_t ByteStream::read(char* to, size_t count) {
  if (isAtEnd()) return 0;
  const size_t taken = std::min(count, end_ - begin_);
  const char* const from = buffer_.data() + begin_;
  if (to) std::memcpy(to, from, taken);
  checksum_ =
      static_cast<uint32_t>(crc32(checksum_, reinterpret_cast<const Bytef*>(from), static_cast<uInt>(taken)));
  begin_ += taken;
  return taken;
}

std::string ByteStream::takeUpTo(uint64_t count) {
  constexpr uint64_t kStep = 1 << 20;
  std::string bytes;
  while (bytes.size() < count) {
    size_t at = bytes.size();
    bytes.resize(std::min(count, bytes.size() + std::max<uint64_t>(kStep, bytes.size())));
    while (at < bytes.size()) {
      const size_t taken = read(bytes.data() + at, bytes.size() - at);
      at += taken;
      if (taken == 0) {
        bytes.resize(at);
        return bytes;
      }
    }
  }
  return bytes;
}

std::string ByteStream::take(uint64_t count) {
  std::string bytes = takeUpTo(count);
  if (bytes.size() < count) throw CutOff();
  return bytes;
}

void ByteStream::skip(uint64_t count) {
  while (count > 0) {
    const size_t taken = read(nullptr, std::min<uint64_t>(count, buffer_.size()));
    if (taken == 0) throw CutOff();
    count -= taken;
  }
}

}  // namespace hybrid_slam::bags
