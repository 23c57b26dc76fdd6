#include "base/Terminal.h"

#include <algorithm>
#include <sstream>

namespace hybrid_slam {
namespace {

constexpr size_t kLongestMessage = 10000;  // bytes: more than two paths

/// The number of bytes of the valid UTF-8 character at the beginning; 0 if there is none.
size_t utf8Size(std::string_view text) {
  const auto byte = [text](size_t i) { return static_cast<unsigned char>(text[i]); };
  const size_t size = byte(0) < 0x80   ? 1
                      : byte(0) < 0xc2 ? 0
                      : byte(0) < 0xe0 ? 2
                      : byte(0) < 0xf0 ? 3
                      : byte(0) < 0xf5 ? 4
                                       : 0;
  if (size > text.size()) return 0;
  for (size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return size;
}

bool isControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  const bool isC1 = first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
  return first < 0x20 || first == 0x7f || isC1;
}

}  // namespace

std::string onOneLine(std::string_view text) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string line;
  while (!text.empty()) {
    if (line.size() > kLongestMessage) return line + "... and " + std::to_string(text.size()) + " bytes more";
    const size_t size = utf8Size(text);
    const std::string_view character = text.substr(0, std::max<size_t>(size, 1));
    text.remove_prefix(character.size());
    if (character == "\n" || character == "\t") {
      line += ' ';
    } else if (size > 0 && !isControl(character)) {
      line += character;
    } else {
      for (const char c : character)
        line.append("\\x").append(1, kDigits[static_cast<unsigned char>(c) >> 4]).append(1, kDigits[c & 15]);
    }
  }
  return line;
}

std::vector<std::string> wrapped(const std::string& text, size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > width)
      lines.push_back(word);
    else
      lines.back() += ' ' + word;
  }
  return lines;
}

}  // namespace hybrid_slam
