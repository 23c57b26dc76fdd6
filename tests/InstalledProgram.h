/// @file InstalledProgram.h
/// @brief For the tests: a program as installed by `cmake --install`.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "files/TemporaryFolder.h"

namespace hybrid_slam::test {

/// PREFIX/bin/PROGRAM and an empty folder PREFIX/share/hybrid_slam/data, in a folder of the test.
class InstalledProgram {
 public:
  InstalledProgram(const files::TemporaryFolder& folder, const std::string& built)
      : path(folder.path("prefix/bin/" + std::filesystem::path(built).filename().string())),
        data_(folder.path("prefix/share/hybrid_slam/data/")) {
    std::filesystem::create_directories(data_);
    std::filesystem::create_directories(folder.path("prefix/bin"));
    std::error_code isOnAnotherDisk;
    std::filesystem::create_hard_link(built, path, isOnAnotherDisk);
    if (isOnAnotherDisk) std::filesystem::copy_file(built, path);
  }
  /// Path of the installed file that users call `data/NAME`.
  std::string data(const std::string& name) const { return data_ + name; }

  const std::string path;  ///< of the program

 private:
  std::string data_;
};

}  // namespace hybrid_slam::test
