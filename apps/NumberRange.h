/// @file NumberRange.h
/// @brief The range of a number on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/Numbers.h"

namespace hybrid_slam {

/// A range check that rejects `nan`, which CLI::Range accepts.
inline CLI::Validator within(double low, double high) {
  const std::string range = numberText(low) + ".." + numberText(high);
  return {[low, high, range](const std::string& given) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(given, value) && value >= low && value <= high) return {};
            return "`" + given + "` is not a number in " + range;
          },
          range};
}

}  // namespace hybrid_slam
