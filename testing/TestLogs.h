/// @file TestLogs.h
/// @brief For the tests: logs of the robot in the room, and other files.
#pragma once

#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "files/RawlogWriter.h"
#include "testing/RoomLog.h"

namespace hybrid_slam::test {

inline std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Paths of a folder's entries whose names begin with a text, in alphabetical order; empty if there is no
/// folder.
inline std::vector<std::string> filesIn(const std::string& folder, const std::string& beginning) {
  std::vector<std::string> paths;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().filename().string().rfind(beginning, 0) == 0) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Writes a gzipped rawlog; returns its path.
inline std::string writeGzipped(const std::string& path, const Log& log) {
  files::RawlogWriter writer(path);
  for (const auto& object : log) writer.write(*object);
  writer.finish();
  return path;
}

/// Writes an uncompressed rawlog; returns its path. `ends` receives the end offset of each object.
inline std::string writePlain(const std::string& path, const Log& log, std::vector<size_t>* ends = nullptr) {
  mrpt::io::CFileOutputStream out(path);
  auto archive = mrpt::serialization::archiveFrom(out);
  for (const auto& object : log) {
    archive << *object;
    if (ends) ends->push_back(out.getPosition());
  }
  return path;
}

}  // namespace hybrid_slam::test
