/// @file IncompressibleText.h
/// @brief For the tests: text that compresses by about half, so that half of a file holds half of the text.
#pragma once

#include <cstdint>
#include <string>

namespace hybrid_slam::test {

/// Lines of pseudo-random digits, about 20 bytes each, of `length` bytes or a few more.
inline std::string incompressibleText(size_t length) {
  std::string text;
  for (uint64_t state = 1; text.size() < length;
       state = state * 6364136223846793005ULL + 1442695040888963407ULL)
    text += std::to_string(state) + "\n";
  return text;
}

}  // namespace hybrid_slam::test
