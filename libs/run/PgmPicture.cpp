/// @file PgmPicture.cpp
/// @brief Netpbm's grey pictures: P5 (binary) and P2 (text).

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "run/PictureFile.h"

namespace hybrid_slam::run {
namespace {

bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

class PgmReader {
 public:
  explicit PgmReader(std::string_view bytes) : rest_(bytes) {}

  size_t number() {
    skipSpace();
    size_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc())
      throw std::runtime_error(rest_.empty() ? "cut off" : "no number where one is needed");
    rest_.remove_prefix(static_cast<size_t>(end - rest_.data()));
    return value;
  }
  /// Skips the single white space between the header of P5 and its pixels.
  void separator() {
    if (rest_.empty() || !isSpace(rest_[0])) throw std::runtime_error("no pixels");
    rest_.remove_prefix(1);
  }
  /// Reads a big-endian number of one or two bytes, which must exist.
  size_t sample(size_t size) {
    size_t value = 0;
    for (size_t i = 0; i < size; ++i) value = value << 8 | static_cast<uint8_t>(rest_[i]);
    rest_.remove_prefix(size);
    return value;
  }
  void skip(size_t count) { rest_.remove_prefix(count); }
  size_t left() const { return rest_.size(); }
  bool isAtEnd() {
    skipSpace();
    return rest_.empty();
  }

 private:
  void skipSpace() {
    while (!rest_.empty() && (isSpace(rest_[0]) || rest_[0] == '#'))
      rest_.remove_prefix(rest_[0] == '#' ? std::min(rest_.find('\n'), rest_.size()) : 1);
  }
  std::string_view rest_;
};

}  // namespace

GreyPicture decodePgm(const std::string& bytes) {
  constexpr size_t kWhite = 255, kLargest = 65535;
  PgmReader in(bytes);
  in.skip(2);
  GreyPicture picture;
  picture.width = in.number(), picture.height = in.number();
  const size_t white = in.number();
  checkSize(picture.width, picture.height);
  if (white == 0 || white > kLargest) throw std::runtime_error("a white of " + std::to_string(white));
  const bool isPlain = bytes[1] == '2';
  const size_t size = white > kWhite ? 2 : 1, pixels = picture.width * picture.height;
  in.separator();
  if (in.left() < pixels * (isPlain ? 1 : size)) throw std::runtime_error("cut off");
  picture.grey.resize(pixels);
  for (uint8_t& grey : picture.grey) {
    const size_t value = isPlain ? in.number() : in.sample(size);
    if (value > white) throw std::runtime_error("a pixel brighter than white");
    grey = static_cast<uint8_t>((value * kWhite + white / 2) / white);
  }
  if (!in.isAtEnd()) throw std::runtime_error("bytes after the pixels");
  return picture;
}

}  // namespace hybrid_slam::run
