#include "files/LineReader.h"

#include <array>
#include <cstring>

#include "base/Errors.h"
#include "files/CompressedFile.h"

namespace hybrid_slam::files {
namespace {

constexpr size_t kLineBuffer = 1 << 16;

}  // namespace

void removeByteOrderMark(std::string& line) {
  if (line.rfind("\xEF\xBB\xBF", 0) == 0) line.erase(0, 3);
}

LineReader::LineReader(const std::string& path)
    : path_(path),
      file_(std::make_unique<CompressedFile>(path, "expected a log, plain or compressed")),
      buffer_(kLineBuffer) {}

LineReader::~LineReader() = default;

void LineReader::rewind() {
  file_->rewind();
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
    if (newline) return count(line);
  }
  return !line.empty() && count(line);
}

bool LineReader::count(std::string& line) {
  if (++number_ == 1) removeByteOrderMark(line);
  return true;
}

/// Refills the empty buffer; false at the end of the file.
bool LineReader::fill() {
  position_ = 0;
  end_ = file_->read(buffer_.data(), buffer_.size());
  if (end_ == 0 && !file_->defect().empty())
    throw InputError(file_->defect(), path_ + ", after line " + std::to_string(number_),
                     "expected a whole file" + (file_->reason().empty() ? "" : ": " + file_->reason()));
  return end_ > 0;
}

bool isText(const std::string& path) {
  try {
    CompressedFile file(path, "");
    std::array<char, 512> start{};
    size_t count = 0;
    while (const size_t got = file.read(start.data() + count, start.size() - count)) count += got;
    return count > 0 && !std::memchr(start.data(), 0, count);
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace hybrid_slam::files
