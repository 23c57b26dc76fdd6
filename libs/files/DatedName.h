/// @file DatedName.h
/// @brief Unique names from the date and time.
#pragma once

#include <functional>
#include <string>

namespace hybrid_slam::files {

/// Returns the first of DATE, DATE-2, DATE-3, ... that `claim` accepts, where DATE is the local time as
/// YYYY-MM-DDTHH-MM-SS. `claim` must create what it accepts, so that another process in the same second gets
/// the next name.
std::string claimDatedName(const std::function<bool(const std::string& name)>& claim);

/// Returns whether a file's name ends with such a date before its extension, as that of a recording does.
bool hasDate(const std::string& path);

}  // namespace hybrid_slam::files
