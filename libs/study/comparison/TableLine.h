/// @file TableLine.h
/// @brief A line of a table written by hybrid-slam.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace hybrid_slam::comparison {

/// Returns the cells of a row; a comma at the end ends the last one.
inline std::vector<std::string> splitAtCommas(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace hybrid_slam::comparison
