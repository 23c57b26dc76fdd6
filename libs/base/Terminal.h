/// @file Terminal.h
/// @brief Text on a terminal, also from files and the network.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hybrid_slam {

/// Puts a text on one line that cannot control the terminal: control characters of ASCII and of UTF-8 (C1)
/// and bytes that are not UTF-8 become `\x1b` and the like, line breaks and tabs become spaces. Cuts it after
/// 10,000 bytes.
std::string onOneLine(std::string_view text);

/// Breaks a text between words into lines of at most `width` bytes; a longer word has a line of its own.
std::vector<std::string> wrapped(const std::string& text, size_t width);

}  // namespace hybrid_slam
