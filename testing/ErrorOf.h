/// @file ErrorOf.h
/// @brief For the tests: the message of an error.
#pragma once

#include <functional>
#include <string>

#include "base/Errors.h"

namespace hybrid_slam::test {

/// Calls a function; returns the message of its error, or "no error".
template <class Error = InputError>
std::string errorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace hybrid_slam::test
