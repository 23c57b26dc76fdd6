/// @file DatedName.h
/// @brief Names that no other run has: the date and time.
#pragma once

#include <functional>
#include <string>

namespace hybrid_slam::files {

/// The first of DATE, DATE-2, DATE-3, ..., with DATE the local time as YYYY-MM-DDTHH-MM-SS, that `claim`
/// accepts. It must create what it accepts, so that another process of the same second gets the next.
std::string claimDatedName(const std::function<bool(const std::string& name)>& claim);

}  // namespace hybrid_slam::files
