/// @file ResultFiles.h
/// @brief For the tests: result files of a run.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace hybrid_slam::test {

/// All files that a replay writes.
inline const std::vector<std::string> kResults{
    "trajectory.tum",   "map.png",      "map.pgm",    "map.yaml",       "map.gridmap.gz",
    "map.simplemap.gz", "lines.csv",    "plan.svg",   "plan.dxf",       "plan.geojson",
    "steps.csv",        "metrics.json", "config.ini", "covariance.csv", "session.hslam"};

/// Contents of a folder; empty if there is none.
inline std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names.push_back(entry.path().filename().string());
  return names;
}

/// The cells of a table, row by row, the head first.
inline std::vector<std::vector<std::string>> csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

}  // namespace hybrid_slam::test
