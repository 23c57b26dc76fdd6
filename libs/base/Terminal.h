/// @file Terminal.h
/// @brief Text from files and the network on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace hybrid_slam {

/// Puts a text on one line that cannot control the terminal: control characters of ASCII and of UTF-8 (C1)
/// and bytes that are not UTF-8 become `\x1b` and the like, line breaks and tabs become spaces. Cuts it after
/// 10,000 bytes.
std::string onOneLine(std::string_view text);

}  // namespace hybrid_slam
