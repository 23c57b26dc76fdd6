#include "files/CompressedFile.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/Errors.h"
#include "files/InputFile.h"

namespace hybrid_slam::files {
namespace {

constexpr size_t kBufferSize = 1 << 16;

std::FILE* openForReading(const std::string& path, const std::string& expected) {
  expectFile(path, expected);
  errno = 0;
  std::FILE* const file = std::fopen(path.c_str(), "rbe");
  if (!file)
    throw InputError("cannot read", path, "expected a readable file: " + std::string(std::strerror(errno)));
  return file;
}

/// Returns the size of an open file.
off_t sizeOf(std::FILE& file) {
  struct stat status {};
  return ::fstat(fileno(&file), &status) == 0 ? status.st_size : 0;
}

}  // namespace

CompressedFile::CompressedFile(const std::string& path, const std::string& expected)
    : file_(openForReading(path, expected), std::fclose), size_(sizeOf(*file_)), buffer_(kBufferSize) {
  rewind();
}

CompressedFile::~CompressedFile() = default;

void CompressedFile::rewind() {
  std::rewind(file_.get());
  unread_ = {};
  defect_.clear();
  reason_.clear();
  refill();
  compression_ = compressionOf(unread_);
  decompressor_ = compression_ ? makeDecompressor(*compression_) : nullptr;
  isBetweenStreams_ = false;
}

void CompressedFile::refill() {
  if (!unread_.empty()) return;
  errno = 0;
  unread_ = {buffer_.data(), std::fread(buffer_.data(), 1, buffer_.size(), file_.get())};
  if (!unread_.empty()) return;
  if (std::ferror(file_.get()))
    fail("cannot read", std::strerror(errno));
  else if (sizeOf(*file_) < size_)
    fail("shortened while it was read", "");
}

size_t CompressedFile::read(char* to, size_t count) {
  refill();
  if (!decompressor_) {
    const size_t taken = std::min(count, unread_.size());
    std::memcpy(to, unread_.data(), taken);
    unread_.remove_prefix(taken);
    return taken;
  }
  size_t room = count;
  while (room == count && count > 0 && defect_.empty()) {
    refill();
    // Like zlib, ignore trailing bytes that are not a stream.
    if (isBetweenStreams_ && (unread_.empty() || unread_.front() == 0)) return 0;
    const size_t left = unread_.size();
    try {
      isBetweenStreams_ = decompressor_->decode(unread_, to, room);
    } catch (const Damaged& damage) {
      if (isBetweenStreams_) return 0;
      fail(std::string("damaged ") + nameOf(*compression_) + " file", damage.what());
    }
    if (room == count && left == 0 && !isBetweenStreams_)
      fail(std::string(nameOf(*compression_)) + " file cut off", "");
  }
  return count - room;
}

void CompressedFile::fail(const std::string& defect, const std::string& reason) {
  if (!defect_.empty()) return;
  defect_ = defect;
  reason_ = reason;
}

}  // namespace hybrid_slam::files
