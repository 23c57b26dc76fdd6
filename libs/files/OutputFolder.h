/// @file OutputFolder.h
/// @brief Result files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "files/PartialFile.h"

namespace hybrid_slam::files {

/// A folder of results.
class OutputFolder {
 public:
  /// Makes the folder if it is missing.
  /// @throws InputError if it cannot be made or written to
  explicit OutputFolder(const std::string& folder);

  /// Writes a file by `fill`.
  /// @throws InputError if it cannot be written whole (a full disk); nothing is left then
  void write(const std::string& name, const std::function<void(std::ostream&)>& fill) const;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// A file that grows during a run and gets its name at the end; without `finish` it vanishes.
class GrowingFile {
 public:
  /// @throws InputError if it cannot be opened
  explicit GrowingFile(const std::string& path);

  std::ostream& stream() { return out_; }
  /// @throws InputError if it could not be written whole
  void finish();

 private:
  PartialFile file_;
  std::ofstream out_;
};

}  // namespace hybrid_slam::files
