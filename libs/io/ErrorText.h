/// @file ErrorText.h
/// @brief What an exception says, in one line.
#pragma once

#include <exception>
#include <string>

namespace hybrid_slam {

/// The message alone: MRPT's exceptions tell their place in the code and the call stack too, in many lines.
std::string oneLine(const std::exception& exception);

}  // namespace hybrid_slam
