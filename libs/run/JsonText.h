/// @file JsonText.h
/// @brief JSON as written to files and to the screen.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hybrid_slam::run {

/// Returns the text of a value, with a line end. Bytes that are no UTF-8, as in old file names, are replaced
/// by U+FFFD: they must not cost the file.
inline std::string jsonText(const nlohmann::ordered_json& value) {
  return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace hybrid_slam::run
