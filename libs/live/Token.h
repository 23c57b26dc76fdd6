/// @file Token.h
/// @brief The secret that a client shows to an observation-server. It travels as plain text
/// (doc/security.md).
#pragma once

#include <string>

namespace hybrid_slam::live {

constexpr size_t kMinToken = 16, kMaxToken = 256;  ///< characters

/// Returns the first line of a file; empty if no file is named.
/// @throws InputError if it cannot be read, or is not of kMinToken to kMaxToken characters
std::string readToken(const std::string& file, const std::string& where);

/// Compares tokens in a time that does not depend on where they differ.
bool isSameToken(const std::string& shown, const std::string& expected);

/// Returns whether only this machine can reach the address.
bool isLoopback(const std::string& address);

}  // namespace hybrid_slam::live
