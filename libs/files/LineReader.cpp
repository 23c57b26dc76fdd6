#include "files/LineReader.h"

#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/Errors.h"

namespace hybrid_slam::files {
namespace {

constexpr size_t kBufferSize = 1 << 16;
constexpr size_t kLongestLine = 1 << 20;

gzFile_s* openForReading(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw InputError("no such file", path, "expected a log, plain or gzipped");
  // zlib opens a folder without an error and fails at the first read.
  if (std::filesystem::is_directory(path, ignored))
    throw InputError("a folder, not a file", path, "expected a log, plain or gzipped");
  errno = 0;
  gzFile_s* file = gzopen(path.c_str(), "rb");
  if (!file)
    throw InputError("cannot read", path, std::string("expected a readable file: ") + std::strerror(errno));
  return file;
}

}  // namespace

LineReader::LineReader(const std::string& path)
    : path_(path), file_(openForReading(path), gzclose_r), buffer_(kBufferSize) {}

void LineReader::rewind() {
  gzrewind(file_.get());
  position_ = end_ = number_ = 0;
}

bool LineReader::next(std::string& line) {
  line.clear();
  while (position_ < end_ || fill()) {
    const char* begin = buffer_.data() + position_;
    const void* newline = std::memchr(begin, '\n', end_ - position_);
    const size_t length = newline ? static_cast<const char*>(newline) - begin : end_ - position_;
    line.append(begin, length);
    position_ += length + (newline ? 1 : 0);
    if (line.size() > kLongestLine)
      throw InputError("not a text log", path_ + ", line " + std::to_string(number_ + 1),
                       "expected lines of at most 1 MiB");
    if (newline) {
      ++number_;
      return true;
    }
  }
  if (line.empty()) return false;
  ++number_;
  return true;
}

/// Refills the empty buffer; false at the end of the file.
bool LineReader::fill() {
  errno = 0;
  const int got = gzread(file_.get(), buffer_.data(), static_cast<unsigned>(buffer_.size()));
  position_ = 0;
  end_ = got > 0 ? static_cast<size_t>(got) : 0;
  if (got > 0) return true;

  int code = Z_OK;
  const char* message = gzerror(file_.get(), &code);
  const std::string where = path_ + ", after line " + std::to_string(number_);
  if (code == Z_BUF_ERROR) throw InputError("gzip file cut off", where, "expected a whole gzip file");
  if (code == Z_ERRNO)
    throw InputError("cannot read", where, std::string("expected a readable file: ") + std::strerror(errno));
  if (code != Z_OK && code != Z_STREAM_END)
    throw InputError("damaged gzip file", where, std::string("expected a whole gzip file: ") + message);
  return false;
}

bool isText(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file(gzopen(path.c_str(), "rb"), gzclose_r);
  std::array<char, 512> start{};
  const int got = file ? gzread(file.get(), start.data(), start.size()) : 0;
  return got > 0 && !std::memchr(start.data(), 0, static_cast<size_t>(got));
}

}  // namespace hybrid_slam::files
